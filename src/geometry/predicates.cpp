#include "geometry/predicates.h"

#include <array>

#include "base/double_double.h"
#include "base/processors.h"
#include "geometry/expansion.h"

namespace vorpipe::core {
namespace {

/// A point relative to d, lifted to the paraboloid: x, y and x^2 + y^2.
struct Lifted {
  Expansion<2> x, y;
  Expansion<16> squared;
  Lifted(Point p, Point d) : x(difference(p.x, d.x)), y(difference(p.y, d.y)), squared(x * x + y * y) {}
};

/// Whether a, b and c, d are the parallel sides of a trapezoid symmetric about an axis-parallel line: its
/// corners lie on a circle. Rectangles are among these.
bool isMirrored(Point a, Point b, Point c, Point d) {
  const auto haveOneMiddle = [](double p, double q, double r, double s) {
    return DoubleDouble::sum(p, q) == DoubleDouble::sum(r, s);
  };
  return (a.y == b.y && c.y == d.y && haveOneMiddle(a.x, b.x, c.x, d.x)) ||
         (a.x == b.x && c.x == d.x && haveOneMiddle(a.y, b.y, c.y, d.y));
}

/// a - b if a double holds it; else NaN.
double plainDifference(double a, double b) {
  const auto d = DoubleDouble::sum(a, -b);
  return d.low == 0 ? d.high : std::numeric_limits<double>::quiet_NaN();
}

/// The sign of inCircle by pairs of doubles, for points relative to d; 0 if these do not decide it. A product
/// of two doubles is exact. A sum of pairs has a relative error of 3 u^2, a product of 5 u^2. In total that
/// is less than 20 u^2 of the sum of the terms' magnitudes. NaN decides nothing.
FOR_FUSED_TOO int inCircleByPairs(const std::array<double, 3>& x, const std::array<double, 3>& y) {
  constexpr double rounding = 0x1p-100;
  DoubleDouble inside;
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto m = (k + 1) % 3, n = (k + 2) % 3;
    const auto left = DoubleDouble::product(x[m], y[n]), right = DoubleDouble::product(y[m], x[n]);
    const auto squared = DoubleDouble::product(x[k], x[k]) + DoubleDouble::product(y[k], y[k]);
    inside = inside + squared * (left - right);
    size += squared.high * (std::abs(left.high) + std::abs(right.high));
  }
  if (!(std::abs(inside.high) > rounding * size)) return 0;
  return inside.high > 0 ? 1 : -1;
}

template <class Any>
int sideOfOrigin(const Any& p, const Any& q, const Any& r) {
  const auto minor = [](const Any& s, const Any& t) { return s.x * t.y - s.y * t.x; };
  return (p.squared * minor(q, r) + q.squared * minor(r, p) + r.squared * minor(p, q)).sign();
}

}  // namespace

int exactOrientation(Point a, Point b, Point c) {
  const auto left = difference(a.x, c.x) * difference(b.y, c.y);
  const auto right = difference(a.y, c.y) * difference(b.x, c.x);
  return (left - right).sign();
}

/// Pairs of doubles decide most cases near a circle, and lattices are full of trapezoids; expansions take ten
/// times as long.
int exactInCircle(Point a, Point b, Point c, Point d) {
  if (isMirrored(a, b, c, d) || isMirrored(b, c, a, d) || isMirrored(c, a, b, d)) return 0;
  const int inside =
      inCircleByPairs({plainDifference(a.x, d.x), plainDifference(b.x, d.x), plainDifference(c.x, d.x)},
                      {plainDifference(a.y, d.y), plainDifference(b.y, d.y), plainDifference(c.y, d.y)});
  if (inside != 0) return inside;
  return sideOfOrigin(Lifted(a, d), Lifted(b, d), Lifted(c, d));
}

/// The four are corners of a convex polygon. The point raised most lifts the circle's plane at d if d lies on
/// its side of the other two; otherwise it lowers the plane.
int brokenTie(Point a, Point b, Point c, Point d) {
  const auto isBeyond = [](Point p, Point q) { return p.x != q.x ? p.x > q.x : p.y > q.y; };
  if (isBeyond(d, a) && isBeyond(d, b) && isBeyond(d, c)) return -1;
  if (isBeyond(a, b) && isBeyond(a, c)) return orientation(b, c, d);
  return isBeyond(b, c) ? orientation(c, a, d) : orientation(a, b, d);
}

int exactInCircle(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                  const WeightedPoint& d) {
  return sideOfOrigin(LiftedByWeight(a, d), LiftedByWeight(b, d), LiftedByWeight(c, d));
}

int inInterval(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& p) {
  const LiftedByWeight lifted_a(a, p), lifted_b(b, p);
  const bool level = a.x != b.x;
  const auto& at_a = level ? lifted_a.x : lifted_a.y;
  const auto& at_b = level ? lifted_b.x : lifted_b.y;
  return (lifted_a.squared * at_b - lifted_b.squared * at_a).sign() * (at_b - at_a).sign();
}

}  // namespace vorpipe::core
