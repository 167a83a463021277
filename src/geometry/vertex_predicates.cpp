#include "geometry/vertex_predicates.h"

#include <algorithm>
#include <cmath>

#include "geometry/expansion.h"

namespace vorpipe::core {
namespace {

/// To first order, with u = 2^-53 and relative to sums of magnitudes: a difference is off by u, its square by
/// 3 u, two squares and a weight by 5 u, times a difference by 7 u, two of those by 8 u. (from - at) times
/// twice the area is off by 6 u, and the sum of both by 9 u. 4e-15 is 36 u.
constexpr double center_error = 4e-15;
/// Two squares are off by 4 u, and aa - bb - weight_difference by 6 u of aa + bb, at most 12 u of the larger.
/// 2e-15 is 18 u.
constexpr double nearer_error = 2e-15;

/// The sign of x - at, with x that of the center of the circle through a, b, c, which run counter-clockwise:
/// x = a.x + (c.y |b|^2 - b.y |c|^2) / (2 b x c), with b and c relative to a. The amount by which a is
/// heavier is added to the squares.
int exactCenterSide(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c, double at) {
  const LiftedByWeight to_b(b, a), to_c(c, a);
  const auto left = to_c.y * to_b.squared - to_b.y * to_c.squared;
  const auto way = difference(a.x, at);
  const auto right = (way + way) * (to_b.x * to_c.y - to_b.y * to_c.x);
  return (left + right).sign();
}

WeightedPoint swapped(const WeightedPoint& p) { return {{p.y, p.x}, p.weight}; }

int signOf(double value) { return value > 0 ? 1 : (value < 0 ? -1 : 0); }

/// To first order, with u = 2^-53 and relative to the sum of the terms' magnitudes: the vector from a to the
/// center, times twice the area, is off by 8 u, as above; times a difference, by 10 u. The side
/// on which a lies is off by 4 u; times twice the area, by 9 u. The sum of both is off by 12 u. At a wall
/// there are fewer steps. 4e-15 is 36 u.
constexpr double on_line_error = 4e-15;

/// The side, times the sign of the area of a, b and c.
int exactCenterSide(Point p, Point q, const WeightedPoint& a, const WeightedPoint& b,
                    const WeightedPoint& c) {
  const LiftedByWeight to_b(b, a), to_c(c, a);
  const auto twice_area = to_b.x * to_c.y - to_b.y * to_c.x;
  const auto dx = difference(q.x, p.x), dy = difference(q.y, p.y);
  const auto at_a = dx * difference(a.y, p.y) - dy * difference(a.x, p.x);
  const auto way = dx * (to_b.x * to_c.squared - to_c.x * to_b.squared) -
                   dy * (to_c.y * to_b.squared - to_b.y * to_c.squared);
  return (way + at_a * (twice_area + twice_area)).sign();
}

/// The side, times the sign of b.y - a.y.
int exactSideAtWall(Point p, Point q, const WeightedPoint& a, const WeightedPoint& b, double wall) {
  const LiftedByWeight to_b(b, a);
  const auto to_wall = difference(wall, a.x);
  const auto from_a = to_b.squared - to_b.x * (to_wall + to_wall);
  const auto dx = difference(q.x, p.x), dy = difference(q.y, p.y);
  const auto twice_y = to_b.y + to_b.y;
  return (dx * (from_a + twice_y * difference(a.y, p.y)) - dy * (twice_y * difference(wall, p.x))).sign();
}

}  // namespace

std::uint8_t wallsReached(const Box& domain, const WeightedPoint& a, const WeightedPoint& b,
                          const WeightedPoint& c) {
  const double bx = b.x - a.x, by = b.y - a.y;
  const double cx = c.x - a.x, cy = c.y - a.y;
  const double b_weight = a.weight - b.weight, c_weight = a.weight - c.weight;
  const double b_size = bx * bx + by * by + std::abs(b_weight),
               c_size = cx * cx + cy * cy + std::abs(c_weight);
  const double bb = bx * bx + by * by + b_weight, cc = cx * cx + cy * cy + c_weight;
  const double twice = 2 * (bx * cy - by * cx), size = 2 * (std::abs(bx * cy) + std::abs(by * cx));
  const auto side = [&](double at, double from, double way, double way_size, const auto& exactly) {
    const double value = way + (from - at) * twice;
    const double error = center_error * (way_size + std::abs(from - at) * size);
    return std::abs(value) > error ? signOf(value) : exactly(at);
  };
  const double x = cy * bb - by * cc, x_size = std::abs(cy) * b_size + std::abs(by) * c_size;
  const double y = bx * cc - cx * bb, y_size = std::abs(bx) * c_size + std::abs(cx) * b_size;
  const auto exactX = [&](double at) { return exactCenterSide(a, b, c, at); };
  // Swapping x and y reverses the triangle.
  const auto exactY = [&](double at) { return exactCenterSide(swapped(a), swapped(c), swapped(b), at); };
  unsigned reached = 0;
  if (side(domain.xmin, a.x, x, x_size, exactX) <= 0) reached |= wallBit(wall_xmin);
  if (side(domain.xmax, a.x, x, x_size, exactX) >= 0) reached |= wallBit(wall_xmax);
  if (side(domain.ymin, a.y, y, y_size, exactY) <= 0) reached |= wallBit(wall_ymin);
  if (side(domain.ymax, a.y, y, y_size, exactY) >= 0) reached |= wallBit(wall_ymax);
  return static_cast<std::uint8_t>(reached);
}

int nearerOf(const WeightedPoint& a, const WeightedPoint& b, Point p) {
  const double ax = p.x - a.x, ay = p.y - a.y, bx = p.x - b.x, by = p.y - b.y;
  const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, weight_difference = a.weight - b.weight;
  const double farther = aa - bb - weight_difference;
  if (std::abs(farther) > nearer_error * (std::max(aa, bb) + std::abs(weight_difference)))
    return farther < 0 ? -1 : 1;
  const auto squared = [p](Point from) {
    const auto x = difference(p.x, from.x), y = difference(p.y, from.y);
    return x * x + y * y;
  };
  return (squared(a) - squared(b) - difference(a.weight, b.weight)).sign();
}

int middleSide(const WeightedPoint& a, const WeightedPoint& b, double x) {
  const auto way = difference(b.x, a.x);
  const auto sum = (difference(a.x, x) + difference(b.x, x)) * way + difference(a.weight, b.weight);
  return sum.sign() * way.sign();
}

/// The center is a + (cy bb - by cc, bx cc - cx bb) / (2 b x c), with b and c relative to a. bb and cc are
/// their squares plus the amount by which a is heavier.
std::optional<int> centerSide(Point p, Point q, const WeightedPoint& a, const WeightedPoint& b,
                              const WeightedPoint& c) {
  const int turn = orientation(a, b, c);
  if (turn == 0) return {};
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  const double b_weight = a.weight - b.weight, c_weight = a.weight - c.weight;
  const double b_size = bx * bx + by * by + std::abs(b_weight),
               c_size = cx * cx + cy * cy + std::abs(c_weight);
  const double bb = bx * bx + by * by + b_weight, cc = cx * cx + cy * cy + c_weight;
  const double dx = q.x - p.x, dy = q.y - p.y, ax = a.x - p.x, ay = a.y - p.y;
  const double twice = 2 * (bx * cy - by * cx), twice_size = 2 * (std::abs(bx * cy) + std::abs(by * cx));
  const double value = dx * (bx * cc - cx * bb) - dy * (cy * bb - by * cc) + (dx * ay - dy * ax) * twice;
  const double size = std::abs(dx) * (std::abs(bx) * c_size + std::abs(cx) * b_size) +
                      std::abs(dy) * (std::abs(cy) * b_size + std::abs(by) * c_size) +
                      (std::abs(dx * ay) + std::abs(dy * ax)) * twice_size;
  if (std::abs(value) > on_line_error * size) return value > 0 ? turn : -turn;
  return turn * exactCenterSide(p, q, a, b, c);
}

/// At this point 2 bx (wall - ax) + 2 by y = bb, with b relative to a and y to a.y.
std::optional<int> sideAtWall(Point p, Point q, const WeightedPoint& a, const WeightedPoint& b, double wall) {
  if (a.y == b.y) return {};
  const int turn = a.y < b.y ? 1 : -1;
  const double bx = b.x - a.x, by = b.y - a.y, to_wall = wall - a.x, weight = a.weight - b.weight;
  const double from_a = bx * bx + by * by + weight - 2 * bx * to_wall;
  const double from_a_size = bx * bx + by * by + std::abs(weight) + 2 * std::abs(bx * to_wall);
  const double dx = q.x - p.x, dy = q.y - p.y, ay = a.y - p.y, px = wall - p.x;
  const double value = dx * (from_a + 2 * by * ay) - dy * (2 * by * px);
  const double size =
      std::abs(dx) * (from_a_size + 2 * std::abs(by * ay)) + std::abs(dy) * (2 * std::abs(by * px));
  if (std::abs(value) > on_line_error * size) return value > 0 ? turn : -turn;
  return turn * exactSideAtWall(p, q, a, b, wall);
}

}  // namespace vorpipe::core
