/// Exact signs of determinants of points: a filter in double with an error bound, and if the filter fails,
/// expansions (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates"). Bounds are relative to the sum of the terms' magnitudes; u is 2^-53.
///
/// Range: coordinates up to 2^240 whose differences are not below 2^-200; weights 0 or from 2^-500 to 2^480.
/// Within it no product overflows, and none of the expansions' products underflows.
#pragma once

#include <cmath>

#include "vorpipe.h"

namespace vorpipe::core {

struct WeightedPoint : Point {
  double weight;
};

int exactOrientation(Point a, Point b, Point c);
int exactInCircle(Point a, Point b, Point c, Point d);
int brokenTie(Point a, Point b, Point c, Point d);
int exactInCircle(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                  const WeightedPoint& d);

/// 1: a, b, c run counter-clockwise; -1: clockwise; 0: they lie on a line. Bound: (3 + 16 u) u, Shewchuk's A.
inline int orientation(Point a, Point b, Point c) {
  constexpr double rounding = 3.3306690738754716e-16;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double area = left - right;
  const double error = rounding * (std::abs(left) + std::abs(right));
  if (std::abs(area) > error) return area > 0 ? 1 : -1;
  return exactOrientation(a, b, c);
}

/// a, b, c run counter-clockwise. 1: d lies inside their circle; -1: outside; 0: on it. Bound: (10 + 96 u) u.
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

/// The same, with ties broken: never 0 for four different points. Points are lifted to the paraboloid x^2 +
/// y^2 and then raised; those of larger x, then of larger y, by infinitely more than others (Edelsbrunner and
/// Mücke 1990, "Simulation of simplicity"). So the sign depends only on the positions of the points.
inline int inCirclePerturbed(Point a, Point b, Point c, Point d) {
  const int inside = inCircle(a, b, c, d);
  return inside != 0 ? inside : brokenTie(a, b, c, d);
}

/// Compares powers |x - site|^2 - weight at the point where those of a, b, c are equal. 1: that of d is less;
/// -1: greater; 0: equal. Bound: 5 u of a lifted term, 4 u of a minor, 3 u to multiply and add them; 4e-15 is
/// 36 u.
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

/// The same, with ties broken as in inCirclePerturbed without weights. But first, all squared distances are
/// scaled by 1 - e, for an infinitesimal e > 0. The sign of its effect is that of the unweighted test,
/// negated. So a point whose cell has no area is hidden.
inline int inCirclePerturbed(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                             const WeightedPoint& d) {
  const int inside = inCircle(a, b, c, d);
  if (inside != 0) return inside;
  const auto plain = [](const WeightedPoint& p) -> const Point& { return p; };
  const int unweighted = inCircle(plain(a), plain(b), plain(c), plain(d));
  return unweighted != 0 ? -unweighted : brokenTie(a, b, c, d);
}

/// p lies on the line through a and b; x is the point of this line where the powers of a and b are equal. 1:
/// that of p is less at x; -1: greater; 0: equal. Always exact, because it is rarely called.
int inInterval(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& p);

}  // namespace vorpipe::core
