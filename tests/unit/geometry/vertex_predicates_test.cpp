#include "geometry/vertex_predicates.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vorpipe {

using namespace core;

namespace {

constexpr std::uint8_t xmin = 1, xmax = 2, ymin = 4, ymax = 8;

WeightedPoint point(double x, double y, double weight = 0) { return {{x, y}, weight}; }

double after(double x) { return std::nextafter(x, 9); }
double before(double x) { return std::nextafter(x, -9); }

TEST(WallsReached, TellCentersOnAWallFromThoseBesideIt) {
  // Integer points on a circle of radius 5 * 2^-20; the center has no rounding.
  const auto at = [](double x, double y) { return point(1 + std::ldexp(x, -20), 1 + std::ldexp(y, -20)); };
  const auto a = at(3, 4), b = at(-4, 3), c = at(3, -4);
  const auto reached = [&](Box box) { return wallsReached(box, a, b, c); };
  EXPECT_EQ(reached({0, 0, 2, 2}), 0);
  EXPECT_EQ(reached({1, 1, 2, 2}), xmin | ymin) << "what lies on a wall is beyond";
  EXPECT_EQ(reached({0, 0, 1, 1}), xmax | ymax);
  EXPECT_EQ(reached({before(1), before(1), after(1), after(1)}), 0);
  EXPECT_EQ(reached({after(1), 0, 2, before(1)}), xmin | ymax);
  EXPECT_EQ(reached({0, after(1), before(1), 2}), xmax | ymin);
  EXPECT_EQ(wallsReached({1, 0, 2, before(1)}, b, c, a), reached({1, 0, 2, before(1)}));
}

TEST(WallsReached, TellTheCenterOfAThinTriangle) {
  // The center is at (0.5, y) with y - 2^-50 = (1 - 2^-98) / 2^-47, far up; and as far down if turned.
  const auto a = point(0, 0), b = point(1, 0), c = point(0.5, 0x1p-50);
  EXPECT_EQ(wallsReached({0, -1e20, 1, 1e20}, a, b, c), 0);
  EXPECT_EQ(wallsReached({0, -1e14, 1, 1e20}, a, b, c), ymin);
  EXPECT_EQ(wallsReached({0.5, -1e20, 1, 1e20}, a, b, c), xmin);
  EXPECT_EQ(wallsReached({0, -1e20, 0.5, 1e20}, a, b, c), xmax);
}

TEST(NearerOf, IsExactOnTheBisector) {
  const auto a = point(0.1, 0.7), b = point(0.3, 0.7);
  const auto middle = point(a.x, 0.7), mirrored = point(-a.x, 0.7);
  EXPECT_EQ(nearerOf(middle, mirrored, {0, 0.123}), 0);
  EXPECT_EQ(nearerOf(middle, mirrored, {0x1p-70, 0.123}), -1);
  EXPECT_EQ(nearerOf(middle, mirrored, {-0x1p-70, 0.123}), 1);
  EXPECT_EQ(nearerOf(a, b, {0.15, 1e9}), -1);
  EXPECT_EQ(nearerOf(b, a, {0.15, 1e9}), 1);
}

TEST(MiddleSide, IsExact) {
  const auto at = [](double x) { return point(x, 0.7); };
  EXPECT_EQ(middleSide(at(0x1p-60), at(2), 1), 1);
  EXPECT_EQ(middleSide(at(-0x1p-60), at(2), 1), -1);
  EXPECT_EQ(middleSide(at(0), at(2), 1), 0);
}

TEST(Walls, AreExactByWeight) {
  // The powers are equal at (0.5, 0.25) for the first three, and with the last at x = 0.5.
  const auto a = point(0, 0, 0.3125), b = point(1, 0, 0.3125), c = point(0.5, 1, 0.5625);
  const auto d = point(2, 0, 2.25 + 0.0625);
  EXPECT_EQ(wallsReached({0, 0, 1, 1}, a, b, c), 0);
  EXPECT_EQ(wallsReached({0.5, 0, 1, 0.25}, a, b, c), xmin | ymax);
  EXPECT_EQ(wallsReached({before(0.5), 0, 1, after(0.25)}, c, a, b), 0);
  EXPECT_EQ(wallsReached({after(0.5), 0, 1, before(0.25)}, b, c, a), xmin | ymax);
  EXPECT_EQ(nearerOf(a, d, {0.5, 123}), 0);
  EXPECT_EQ(nearerOf(a, d, {before(0.5), 123}), -1);
  EXPECT_EQ(nearerOf(a, d, {after(0.5), 123}), 1);
  EXPECT_EQ(middleSide(a, d, 0.5), 0);
  EXPECT_EQ(middleSide(a, d, before(0.5)), 1);
  EXPECT_EQ(middleSide(d, a, after(0.5)), -1);
}

TEST(CenterSide, IsExact) {
  // Whole numbers on a circle of radius 5 * 2^-20 about (1, 1).
  const auto on = [](double x, double y) { return point(1 + std::ldexp(x, -20), 1 + std::ldexp(y, -20)); };
  const auto a = on(3, 4), b = on(-4, 3), c = on(3, -4);
  EXPECT_EQ(centerSide({0, 0}, {3, 3}, a, b, c), 0);
  EXPECT_EQ(centerSide({7, 1}, {-9, 1}, c, a, b), 0);
  EXPECT_EQ(centerSide({0, 0}, {3, after(3)}, a, b, c), -1);
  EXPECT_EQ(centerSide({0, 0}, {3, after(3)}, b, a, c), -1);
  EXPECT_EQ(centerSide({3, after(3)}, {0, 0}, a, b, c), 1);
  EXPECT_EQ(centerSide({7, after(1)}, {-9, 1}, a, b, c), 1);
}

TEST(CenterSide, KnowsCentersThatDoublesDoNotHold) {
  const auto a = point(0, 0), b = point(5, 1), c = point(1, 2);  // (47, -1) / 18
  EXPECT_EQ(centerSide({0, 0}, {47, -1}, a, b, c), 0);
  EXPECT_EQ(centerSide({94, -2}, {-47, 1}, b, c, a), 0);
  EXPECT_EQ(centerSide({0, 0}, {47, after(-1)}, a, b, c), -1);
  const auto heavy = point(0, 0, 1), heavier = point(1, 2, 3);  // (17, -4) / 6
  EXPECT_EQ(centerSide({0, 0}, {17, -4}, heavy, b, heavier), 0);
  EXPECT_EQ(centerSide({0, 0}, {17, after(-4)}, heavy, b, heavier), -1);
}

TEST(CenterSide, IsNothingWithoutACenter) {
  EXPECT_EQ(centerSide({0, 0}, {1, 1}, point(0, 0), point(1, 1), point(3, 3)), std::nullopt);
}

TEST(SideAtWall, IsExact) {
  const auto a = point(0, 0), b = point(1, 3);  // at x = 1 where y = 4/3
  EXPECT_EQ(sideAtWall({0, 0}, {3, 4}, a, b, 1), 0);
  EXPECT_EQ(sideAtWall({3, 4}, {-3, -4}, b, a, 1), 0);
  EXPECT_EQ(sideAtWall({0, 0}, {3, after(4)}, a, b, 1), -1);
  EXPECT_EQ(sideAtWall({0, 0}, {3, after(4)}, b, a, 1), -1);
  EXPECT_EQ(sideAtWall({0, 0}, {3, 4}, a, b, after(1)), -1);
  EXPECT_EQ(sideAtWall({0, 0}, {3, 5}, point(0, 0, 2), b, 1), 0);
  EXPECT_EQ(sideAtWall({0, 0}, {0, 1}, a, point(0.5, 0), 0.25), std::nullopt) << "the bisector is parallel";
}

}  // namespace
}  // namespace vorpipe
