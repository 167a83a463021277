#include "geometry/line_predicates.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vorpipe {

using namespace core;

namespace {

WeightedPoint site(double x, double y, double weight = 0) { return {{x, y}, weight}; }

double next(double x) { return std::nextafter(x, 1e9); }

TEST(CenterSide, IsExact) {
  // Whole numbers on a circle of radius 5 * 2^-20 about (1, 1).
  const auto on = [](double x, double y) { return site(1 + std::ldexp(x, -20), 1 + std::ldexp(y, -20)); };
  const auto a = on(3, 4), b = on(-4, 3), c = on(3, -4);
  EXPECT_EQ(centerSide({0, 0}, {3, 3}, a, b, c), 0);
  EXPECT_EQ(centerSide({7, 1}, {-9, 1}, c, a, b), 0);
  EXPECT_EQ(centerSide({0, 0}, {3, next(3)}, a, b, c), -1);
  EXPECT_EQ(centerSide({0, 0}, {3, next(3)}, b, a, c), -1);
  EXPECT_EQ(centerSide({3, next(3)}, {0, 0}, a, b, c), 1);
  EXPECT_EQ(centerSide({7, next(1)}, {-9, 1}, a, b, c), 1);
}

TEST(CenterSide, KnowsCentersThatDoublesDoNotHold) {
  const auto a = site(0, 0), b = site(5, 1), c = site(1, 2);  // (47, -1) / 18
  EXPECT_EQ(centerSide({0, 0}, {47, -1}, a, b, c), 0);
  EXPECT_EQ(centerSide({94, -2}, {-47, 1}, b, c, a), 0);
  EXPECT_EQ(centerSide({0, 0}, {47, next(-1)}, a, b, c), -1);
  const auto heavy = site(0, 0, 1), heavier = site(1, 2, 3);  // (17, -4) / 6
  EXPECT_EQ(centerSide({0, 0}, {17, -4}, heavy, b, heavier), 0);
  EXPECT_EQ(centerSide({0, 0}, {17, next(-4)}, heavy, b, heavier), -1);
}

TEST(CenterSide, IsNothingWithoutACenter) {
  EXPECT_EQ(centerSide({0, 0}, {1, 1}, site(0, 0), site(1, 1), site(3, 3)), std::nullopt);
}

TEST(SideAtWall, IsExact) {
  const auto a = site(0, 0), b = site(1, 3);  // at x = 1 where y = 4/3
  EXPECT_EQ(sideAtWall({0, 0}, {3, 4}, a, b, 1), 0);
  EXPECT_EQ(sideAtWall({3, 4}, {-3, -4}, b, a, 1), 0);
  EXPECT_EQ(sideAtWall({0, 0}, {3, next(4)}, a, b, 1), -1);
  EXPECT_EQ(sideAtWall({0, 0}, {3, next(4)}, b, a, 1), -1);
  EXPECT_EQ(sideAtWall({0, 0}, {3, 4}, a, b, next(1)), -1);
  EXPECT_EQ(sideAtWall({0, 0}, {3, 5}, site(0, 0, 2), b, 1), 0);
  EXPECT_EQ(sideAtWall({0, 0}, {0, 1}, a, site(0.5, 0), 0.25), std::nullopt) << "the bisector is parallel";
}

}  // namespace
}  // namespace vorpipe
