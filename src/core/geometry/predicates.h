/// Decisions on points of the plane that rounding cannot change: first in double with a bound of the error,
/// and where that does not tell, exactly (Shewchuk 1997, "Adaptive precision floating-point arithmetic and
/// fast robust geometric predicates").
///
/// All are exact for coordinates up to 2^240 whose differences are not below 2^-200, and weights that are 0
/// or between 2^-500 and 2^480.
#pragma once

#include <cmath>

#include "vorpipe.h"

namespace vorpipe::core {

struct WeightedPoint : Point {
  double weight;
};

int exactOrientation(Point a, Point b, Point c);
int exactInCircle(Point a, Point b, Point c, Point d);
int exactInCircle(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                  const WeightedPoint& d);

/// Positive if a, b, c run counter-clockwise, negative if clockwise, 0 if they lie on a line.
inline int orientation(Point a, Point b, Point c) {
  constexpr double rounding = 3.3306690738754716e-16;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double area = left - right;
  const double error = rounding * (std::abs(left) + std::abs(right));
  if (std::abs(area) > error) return area > 0 ? 1 : -1;
  return exactOrientation(a, b, c);
}

/// Positive if d lies inside the circle through a, b, c, which run counter-clockwise; 0 if on it.
inline int inCircle(Point a, Point b, Point c, Point d) {
  constexpr double rounding = 1.1102230246251577e-15;
  const double ax = a.x - d.x, ay = a.y - d.y;
  const double bx = b.x - d.x, by = b.y - d.y;
  const double cx = c.x - d.x, cy = c.y - d.y;
  const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  const double inside = aa * (bx * cy - by * cx) + bb * (cx * ay - cy * ax) + cc * (ax * by - ay * bx);
  const double size = aa * (std::abs(bx * cy) + std::abs(by * cx)) +
                      bb * (std::abs(cx * ay) + std::abs(cy * ax)) +
                      cc * (std::abs(ax * by) + std::abs(ay * bx));
  if (std::abs(inside) > rounding * size) return inside > 0 ? 1 : -1;
  return exactInCircle(a, b, c, d);
}

/// With weights: positive if the power of d, |x - d|^2 - w, is less than those of a, b, c where these are
/// equal; 0 if it is equal to them.
inline int inCircle(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                    const WeightedPoint& d) {
  constexpr double rounding = 4e-15;
  double inside = 0, size = 0;
  const auto add = [&](const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
    const double px = p.x - d.x, py = p.y - d.y, weight_difference = d.weight - p.weight;
    const double left = (q.x - d.x) * (r.y - d.y), right = (q.y - d.y) * (r.x - d.x);
    inside += (px * px + py * py + weight_difference) * (left - right);
    size += (px * px + py * py + std::abs(weight_difference)) * (std::abs(left) + std::abs(right));
  };
  add(a, b, c);
  add(b, c, a);
  add(c, a, b);
  if (std::abs(inside) > rounding * size) return inside > 0 ? 1 : -1;
  return exactInCircle(a, b, c, d);
}

/// For p on the line through a and b: positive if the power of p is less than those of a and b at the line's
/// point where these are equal; 0 if it is equal to them.
int inInterval(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& p);

}  // namespace vorpipe::core
