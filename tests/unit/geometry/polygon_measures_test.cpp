#include "geometry/polygon_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace vorpipe::test {

using namespace core;

namespace {

TEST(MeasurePolygon, aRectangleHasItsTextbookMoments) {
  const std::vector<Point> rectangle{{1, 2}, {5, 2}, {5, 4}, {1, 4}};
  const auto m = measurePolygon(rectangle);
  EXPECT_DOUBLE_EQ(m.area, 8);
  EXPECT_DOUBLE_EQ(m.perimeter, 12);
  EXPECT_NEAR(m.centroid.x, 3, 1e-14);
  EXPECT_NEAR(m.centroid.y, 3, 1e-14);
  EXPECT_NEAR(m.second_moments[0], 2 * 64 / 12.0, 1e-12);
  EXPECT_NEAR(m.second_moments[1], 0, 1e-12);
  EXPECT_NEAR(m.second_moments[2], 4 * 8 / 12.0, 1e-12);
}

TEST(MeasurePolygon, aRightTriangleHasItsTextbookMoments) {
  const std::vector<Point> triangle{{0, 0}, {3, 0}, {0, 4}};
  const auto m = measurePolygon(triangle);
  EXPECT_DOUBLE_EQ(m.area, 6);
  EXPECT_DOUBLE_EQ(m.perimeter, 12);
  EXPECT_NEAR(m.centroid.x, 1, 1e-14);
  EXPECT_NEAR(m.centroid.y, 4 / 3.0, 1e-14);
  EXPECT_NEAR(m.second_moments[0], 4 * 27 / 36.0, 1e-13);
  EXPECT_NEAR(m.second_moments[1], -9 * 16 / 72.0, 1e-13);
  EXPECT_NEAR(m.second_moments[2], 3 * 64 / 36.0, 1e-13);
}

TEST(MeasurePolygon, neitherPlaceNorFirstVertexMattersToTheMoments) {
  const std::vector<Point> here{{0, 0}, {2, 0.5}, {2.5, 2}, {1, 3}, {-0.5, 1.5}};
  std::vector<Point> there{{1, 3}, {-0.5, 1.5}, {0, 0}, {2, 0.5}, {2.5, 2}};
  for (auto& p : there) p = {p.x - 7, p.y + 11};
  const auto a = measurePolygon(here);
  const auto b = measurePolygon(there);
  EXPECT_NEAR(a.area, b.area, 1e-12);
  EXPECT_NEAR(a.perimeter, b.perimeter, 1e-12);
  EXPECT_NEAR(a.centroid.x - 7, b.centroid.x, 1e-12);
  EXPECT_NEAR(a.centroid.y + 11, b.centroid.y, 1e-12);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a.second_moments[k], b.second_moments[k], 1e-10);
}

TEST(MeasurePolygon, manyVerticesComeNearTheCircle) {
  const int count = 100000;
  std::vector<Point> circle;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    circle.push_back({0.25 + std::cos(angle), std::sin(angle)});
  }
  const auto m = measurePolygon(circle);
  EXPECT_NEAR(m.area, std::numbers::pi, 1e-8);
  EXPECT_NEAR(m.perimeter, 2 * std::numbers::pi, 1e-8);
  EXPECT_NEAR(m.centroid.x, 0.25, 1e-12);
  EXPECT_NEAR(m.second_moments[0], std::numbers::pi / 4, 1e-8);
  EXPECT_NEAR(m.second_moments[1], 0, 1e-12);
  EXPECT_NEAR(m.second_moments[2], std::numbers::pi / 4, 1e-8);
}

TEST(MeasurePolygon, aPolygonWithoutAreaHasItsCentroidInTheMean) {
  const std::vector<Point> segment{{1, 1}, {3, 2}};
  const auto m = measurePolygon(segment);
  EXPECT_EQ(m.area, 0);
  EXPECT_DOUBLE_EQ(m.perimeter, 2 * std::sqrt(5));
  EXPECT_EQ(m.centroid.x, 2);
  EXPECT_EQ(m.centroid.y, 1.5);
  EXPECT_EQ(measurePolygon({}).area, 0);
}

}  // namespace
}  // namespace vorpipe::test
