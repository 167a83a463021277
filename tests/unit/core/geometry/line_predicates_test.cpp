#include "core/geometry/line_predicates.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vorpipe {

using namespace core;

namespace {

WeightedPoint site(double x, double y, double weight = 0) { return {{x, y}, weight}; }

double next(double x) { return std::nextafter(x, 1e9); }

TEST(IsCenterOnLine, IsExact) {
  // Whole numbers on a circle of radius 5 * 2^-20 about (1, 1).
  const auto on = [](double x, double y) { return site(1 + std::ldexp(x, -20), 1 + std::ldexp(y, -20)); };
  const auto a = on(3, 4), b = on(-4, 3), c = on(3, -4);
  EXPECT_TRUE(isCenterOnLine({0, 0}, {3, 3}, a, b, c));
  EXPECT_TRUE(isCenterOnLine({7, 1}, {-9, 1}, c, a, b));
  EXPECT_FALSE(isCenterOnLine({0, 0}, {3, next(3)}, a, b, c));
  EXPECT_FALSE(isCenterOnLine({7, next(1)}, {-9, 1}, a, b, c));
}

TEST(IsCenterOnLine, KnowsCentersThatDoublesDoNotHold) {
  const auto a = site(0, 0), b = site(5, 1), c = site(1, 2);  // (47, -1) / 18
  EXPECT_TRUE(isCenterOnLine({0, 0}, {47, -1}, a, b, c));
  EXPECT_TRUE(isCenterOnLine({94, -2}, {-47, 1}, b, c, a));
  EXPECT_FALSE(isCenterOnLine({0, 0}, {47, next(-1)}, a, b, c));
  const auto heavy = site(0, 0, 1), heavier = site(1, 2, 3);  // (17, -4) / 6
  EXPECT_TRUE(isCenterOnLine({0, 0}, {17, -4}, heavy, b, heavier));
  EXPECT_FALSE(isCenterOnLine({0, 0}, {17, next(-4)}, heavy, b, heavier));
}

TEST(IsCenterOnLine, IsFalseWithoutACenter) {
  EXPECT_FALSE(isCenterOnLine({0, 0}, {1, 1}, site(0, 0), site(1, 1), site(3, 3)));
}

TEST(IsOnLineAtWall, IsExact) {
  const auto a = site(0, 0), b = site(1, 3);  // at x = 1 where y = 4/3
  EXPECT_TRUE(isOnLineAtWall({0, 0}, {3, 4}, a, b, 1));
  EXPECT_TRUE(isOnLineAtWall({3, 4}, {-3, -4}, b, a, 1));
  EXPECT_FALSE(isOnLineAtWall({0, 0}, {3, next(4)}, a, b, 1));
  EXPECT_FALSE(isOnLineAtWall({0, 0}, {3, 4}, a, b, next(1)));
  EXPECT_TRUE(isOnLineAtWall({0, 0}, {3, 5}, site(0, 0, 2), b, 1));
  EXPECT_FALSE(isOnLineAtWall({0, 0}, {0, 1}, a, site(0.5, 0), 0.25)) << "the bisector is parallel";
}

}  // namespace
}  // namespace vorpipe
