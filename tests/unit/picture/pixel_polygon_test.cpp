#include "picture/pixel_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/sites/random_sites.h"
#include "vorpipe.h"

namespace vorpipe::test {

using namespace core;

namespace {

using Count = CoveredPixels::Count;

View viewOf(int width, int height) { return {{1, 2, 3, 3}, width, height, {}, {100, 200}}; }

/// Corners of a circle, counter-clockwise.
std::vector<Point> circle(Point center, double radius, int corners) {
  std::vector<Point> polygon;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * M_PI * k / corners;
    polygon.push_back({center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
  }
  return polygon;
}

/// How far a point is inside the line from a to b.
double inside(Point a, Point b, Point p) {
  return ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / std::hypot(b.x - a.x, b.y - a.y);
}

/// Whether p is further in than `least` from every edge.
bool holds(const std::vector<Point>& polygon, Point p, double least) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    if (inside(polygon[k], polygon[(k + 1) % polygon.size()], p) < least) return false;
  }
  return true;
}

TEST(PixelFrame, PutsTheCornersOfTheViewAtTheEndsOfThePixels) {
  const PixelFrame frame(viewOf(40, 20), 8);
  EXPECT_EQ(frame.pixelOf({1, 2}).x, 0);
  EXPECT_EQ(frame.pixelOf({3, 3}).x, 40);
  EXPECT_EQ(frame.pixelOf({3, 3}).y, 20);
  EXPECT_EQ(frame.deviceOf({0, 0}).x, -1);
  EXPECT_EQ(frame.deviceOf({40, 20}).y, 1);
  EXPECT_EQ(frame.erosion(), 0) << "eight bits are fine enough";
  EXPECT_GT(PixelFrame(viewOf(40, 20), 4).erosion(), 0);
}

TEST(CoveredPixels, AreThoseWhoseCentersAPolygonHolds) {
  Random random(3);
  const PixelFrame frame(viewOf(12, 9), 8);
  int ones = 0;
  for (int round = 0; round < 20000; ++round) {
    const auto polygon = circle({14 * random.uniform() - 1, 11 * random.uniform() - 1},
                                1.2 * random.uniform(), 3 + static_cast<int>(random.below(6)));
    std::vector<Point> sure, likely;
    for (int row = 0; row < 9; ++row) {
      for (int column = 0; column < 12; ++column) {
        const Point center{column + 0.5, row + 0.5};
        if (holds(polygon, center, 0)) sure.push_back(center);
        if (holds(polygon, center, -tie_distance)) likely.push_back(center);
      }
    }
    const auto covered = coveredPixels(polygon, frame);
    if (sure.size() > 1) {
      EXPECT_EQ(covered.count, Count::several);
    } else if (covered.count == Count::one) {
      ++ones;
      const auto same = [&](Point p) { return p.x == covered.center.x && p.y == covered.center.y; };
      EXPECT_EQ(std::ranges::count_if(likely, same), 1);
    } else if (!sure.empty()) {
      EXPECT_EQ(covered.count, Count::several);
    }
  }
  EXPECT_GT(ones, 2000);
}

TEST(CoveredPixels, OnAnEdgeBelongToBothSides) {
  const PixelFrame frame(viewOf(4, 4), 8);
  const std::vector<Point> west{{1, 1}, {1.5, 1}, {1.5, 2}, {1, 2}}, east{{1.5, 1}, {2, 1}, {2, 2}, {1.5, 2}};
  EXPECT_EQ(coveredPixels(west, frame).count, Count::one);
  EXPECT_EQ(coveredPixels(east, frame).count, Count::one);
}

TEST(Shrunk, PolygonsHoldCornersThatMove) {
  Random random(5);
  int kept = 0;
  for (int round = 0; round < 2000; ++round) {
    auto polygon = circle({5, 5}, 3 * random.uniform(), 3 + static_cast<int>(random.below(20)));
    for (Point& corner : polygon) corner.y *= 0.3;
    const auto before = polygon;
    const double erosion = 0.03;
    if (!shrink(erosion, polygon)) continue;
    ++kept;
    for (std::size_t k = 0; k < before.size(); ++k) {
      for (const Point corner : polygon) {
        for (const double x : {-erosion, erosion}) {
          for (const double y : {-erosion, erosion}) {
            const Point moved{corner.x + x, corner.y + y};
            EXPECT_GE(inside(before[k], before[(k + 1) % before.size()], moved), -1e-9);
          }
        }
      }
    }
  }
  EXPECT_GT(kept, 1500);
}

TEST(Shrunk, SliversGo) {
  std::vector<Point> sliver{{0, 0}, {10, 0}, {5, 0.04}};
  EXPECT_FALSE(shrink(0.03, sliver));
}

}  // namespace
}  // namespace vorpipe::test
