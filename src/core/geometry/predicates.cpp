#include "core/geometry/predicates.h"

#include "core/geometry/expansion.h"

namespace vorpipe::core {
namespace {

/// A point seen from d, lifted to the paraboloid: x, y and x^2 + y^2.
struct Lifted {
  Expansion<2> x, y;
  Expansion<16> squared;
  Lifted(Point p, Point d) : x(difference(p.x, d.x)), y(difference(p.y, d.y)), squared(x * x + y * y) {}
};

/// The same with a weight, which moves the point down by weight - d.weight.
struct LiftedByWeight {
  Expansion<2> x, y;
  Expansion<18> squared;
  LiftedByWeight(const WeightedPoint& p, const WeightedPoint& d)
      : x(difference(p.x, d.x)),
        y(difference(p.y, d.y)),
        squared(x * x + y * y + difference(d.weight, p.weight)) {}
};

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

int exactInCircle(Point a, Point b, Point c, Point d) {
  return sideOfOrigin(Lifted(a, d), Lifted(b, d), Lifted(c, d));
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
