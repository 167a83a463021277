// Exact signs, expansions and pairs of doubles, beside rational numbers.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/double_double.h"
#include "geometry/expansion.h"
#include "geometry/predicates.h"
#include "support/sites/random_sites.h"
#include "unit/fixtures/brute_force.h"

namespace vorpipe {

using namespace core;
using test::Random;

namespace {

constexpr int trials = 2000;

int signOf(const Rational& number) { return number < 0 ? -1 : number > 0 ? 1 : 0; }

Rational exactly(const DoubleDouble& number) { return Rational(number.high) + Rational(number.low); }

template <std::size_t most>
Rational exactly(const Expansion<most>& sum) {
  Rational whole = 0;
  for (std::size_t k = 0; k < sum.size; ++k) whole += Rational(sum.part[k]);
  return whole;
}

/// Of either sign and of any size from 2^-40 to 2^40.
double anyNumber(Random& random) {
  return std::ldexp(2 * random.uniform() - 1, static_cast<int>(80 * random.uniform()) - 40);
}

/// Whole numbers so small that lines and circles through many of them coincide, some moved by the last place.
Point latticePoint(Random& random) {
  const auto coordinate = [&] {
    const double whole = std::floor(8 * random.uniform());
    return random.uniform() < 0.2 ? std::nextafter(whole, 9.0) : whole;
  };
  const double x = coordinate();
  return {x, coordinate()};
}

Rational determinant(const std::array<std::array<Rational, 3>, 3>& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

std::array<Rational, 3> lifted(const WeightedPoint& p, const WeightedPoint& d) {
  const Rational x = Rational(p.x) - d.x, y = Rational(p.y) - d.y;
  return {x, y, x * x + y * y + Rational(d.weight) - p.weight};
}

TEST(Expansion, IsExact) {
  Random random(1);
  for (int trial = 0; trial < trials; ++trial) {
    std::array<double, 4> n{};
    for (double& number : n) number = anyNumber(random);
    const auto a = difference(n[0], n[1]), b = difference(n[2], n[3]);
    const Rational x = Rational(n[0]) - n[1], y = Rational(n[2]) - n[3];
    EXPECT_EQ(exactly(a), x);
    EXPECT_EQ(exactly(a + b), x + y);
    EXPECT_EQ(exactly(a - b), x - y);
    EXPECT_EQ(exactly(a * b), x * y);
    EXPECT_EQ(exactly(scaled(a, n[3])), x * n[3]);
    EXPECT_EQ((a * b - b * a).sign(), 0);
    EXPECT_EQ((a * b - scaled(b, n[0])).sign(), signOf(x * y - y * n[0]));
  }
}

TEST(DoubleDouble, IsAsPreciseAsItSays) {
  const Rational bound(std::ldexp(1.0, -101));
  Random random(2);
  for (int trial = 0; trial < trials; ++trial) {
    const double p = anyNumber(random), q = anyNumber(random);
    EXPECT_EQ(exactly(DoubleDouble::sum(p, q)), Rational(p) + q);
    EXPECT_EQ(exactly(DoubleDouble::product(p, q)), Rational(p) * q);
    const auto a = DoubleDouble::product(p, q), b = DoubleDouble::sum(anyNumber(random), anyNumber(random));
    const Rational x = exactly(a), y = exactly(b);
    const auto near = [&](const DoubleDouble& found, const Rational& right) {
      return abs(exactly(found) - right) <= bound * abs(right);
    };
    EXPECT_TRUE(near(a * b, x * y));
    EXPECT_TRUE(near(a / b, x / y));
    EXPECT_TRUE(near(abs(a) + abs(b), abs(x) + abs(y)));
    const auto root = sqrt(abs(a));
    EXPECT_LE(abs(exactly(root * root) - abs(x)), 4 * bound * abs(x));
  }
}

TEST(Predicates, AreExactOnLattices) {
  Random random(3);
  int ties = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::array<WeightedPoint, 4> p{};
    for (auto& point : p) point = {latticePoint(random), std::floor(3 * random.uniform())};
    const auto& [a, b, c, d] = p;
    const Rational area =
        (Rational(a.x) - c.x) * (Rational(b.y) - c.y) - (Rational(a.y) - c.y) * (Rational(b.x) - c.x);
    EXPECT_EQ(orientation(a, b, c), signOf(area));
    const WeightedPoint e{a, 0}, f{b, 0}, g{c, 0}, h{d, 0};
    const int plain = signOf(determinant({lifted(e, h), lifted(f, h), lifted(g, h)}));
    const Point q = a, r = b, s = c, t = d;
    EXPECT_EQ(inCircle(q, r, s, t), plain);
    EXPECT_EQ(inCircle(a, b, c, d), signOf(determinant({lifted(a, d), lifted(b, d), lifted(c, d)})));
    ties += plain == 0 ? 1 : 0;
  }
  EXPECT_GT(ties, trials / 100);
}

/// Four corners of a convex polygon on a circle: the tie is broken for one pair of opposite corners.
TEST(Predicates, BreakTiesForOneDiagonal) {
  const std::array<Point, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto at = [&](std::size_t n) { return square[(k + n) % 4]; };
    ASSERT_EQ(inCircle(at(0), at(1), at(2), at(3)), 0);
    const int broken = inCirclePerturbed(at(0), at(1), at(2), at(3));
    EXPECT_NE(broken, 0);
    // Whether the diagonal from corner 0 to corner 2 is kept does not depend on who asks.
    EXPECT_EQ(inCirclePerturbed(at(2), at(3), at(0), at(1)), broken);
    EXPECT_EQ(inCirclePerturbed(at(1), at(2), at(3), at(0)), -broken);
  }
}

}  // namespace
}  // namespace vorpipe
