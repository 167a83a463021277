#include "geometry/line_predicates.h"

#include "geometry/expansion.h"

namespace vorpipe::core {
namespace {

/// To first order, with u = 2^-53 and relative to the sum of the terms' magnitudes: the vector from a to the
/// center, times twice the area, is off by 8 u (wall_predicates.cpp); times a difference, by 10 u. The side
/// on which a lies is off by 4 u; times twice the area, by 9 u. The sum of both is off by 12 u. At a wall
/// there are fewer steps. 4e-15 is 36 u.
constexpr double on_line_error = 4e-15;

/// The side, times the sign of the area of a, b and c.
int exactCenterSide(Point p, Point q, const WeightedPoint& a, const WeightedPoint& b,
                    const WeightedPoint& c) {
  const auto bx = difference(b.x, a.x), by = difference(b.y, a.y);
  const auto cx = difference(c.x, a.x), cy = difference(c.y, a.y);
  const auto twice_area = bx * cy - by * cx;
  const auto bb = bx * bx + by * by + difference(a.weight, b.weight);
  const auto cc = cx * cx + cy * cy + difference(a.weight, c.weight);
  const auto dx = difference(q.x, p.x), dy = difference(q.y, p.y);
  const auto at_a = dx * difference(a.y, p.y) - dy * difference(a.x, p.x);
  const auto way = dx * (bx * cc - cx * bb) - dy * (cy * bb - by * cc);
  return (way + at_a * (twice_area + twice_area)).sign();
}

/// The side, times the sign of b.y - a.y.
int exactSideAtWall(Point p, Point q, const WeightedPoint& a, const WeightedPoint& b, double wall) {
  const auto bx = difference(b.x, a.x), by = difference(b.y, a.y);
  const auto to_wall = difference(wall, a.x);
  const auto bb = bx * bx + by * by + difference(a.weight, b.weight);
  const auto from_a = bb - bx * (to_wall + to_wall);
  const auto dx = difference(q.x, p.x), dy = difference(q.y, p.y);
  const auto up = from_a + (by + by) * difference(a.y, p.y);
  return (dx * up - dy * ((by + by) * difference(wall, p.x))).sign();
}

}  // namespace

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
