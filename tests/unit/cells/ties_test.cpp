/// Cells that meet where more than three do, or nearly so.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/cells/agreed_cells.h"

namespace vorpipe::test {
namespace {

TEST(Cells, whereFourMeetShareOneVertexWhicheverDiagonalsTheySee) {
  const std::vector<std::int32_t> with_diagonal[4] = {{wall_ymin, 1, 2, 3, wall_xmin},
                                                      {wall_ymin, wall_xmax, 2, 3, 0},
                                                      {1, wall_xmax, wall_ymax, 3, 0},
                                                      {0, 1, 2, wall_ymax, wall_xmin}};
  for (unsigned seen = 0; seen < 16; ++seen) {
    auto rows = quarters;
    for (std::size_t i = 0; i < 4; ++i) {
      if ((seen >> i) & 1u) rows[i] = with_diagonal[i];
    }
    const auto result = assemble(quarterSites(), cellsOf(rows));
    ASSERT_TRUE(result.disputed.empty()) << seen;
    const auto& d = result.diagram;
    EXPECT_EQ(broken(d), "") << seen;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(neighborsOf(d, i), fromLowest({quarters[i].begin(), quarters[i].end()})) << seen;
      EXPECT_EQ(d.area[i], 0.25);
    }
    // Site 2 has the largest coordinates, and its ear is cut off: predicates.h.
    EXPECT_EQ(d.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 3}, {1, 2, 3}})) << seen;
  }
}

TEST(Cells, ofALatticeHaveFourNeighborsInside) {
  const std::size_t side = 9;
  const auto set = jitteredSites(side, 0);
  const auto result = assemble(set, cellsOf(rowsOf(set)), 2);
  ASSERT_TRUE(result.disputed.empty());
  EXPECT_EQ(broken(result.diagram), "");
  for (std::size_t i = 0; i < set.size(); ++i) {
    EXPECT_EQ(neighborsOf(result.diagram, i).size(), 4u);
    EXPECT_NEAR(result.diagram.area[i], 1.0 / 81, 1e-16);
  }
  EXPECT_EQ(result.diagram.triangles.size(), 2 * (side - 1) * (side - 1));
}

TEST(Cells, ofSixSitesOnACircleMeetInItsCenter) {
  std::vector<double> x, y;
  for (int k = 0; k < 6; ++k) {
    x.push_back(0.45 + 0.3 * std::cos(0.1 + k * std::numbers::pi / 3));
    y.push_back(0.52 + 0.3 * std::sin(0.1 + k * std::numbers::pi / 3));
  }
  const auto set = sitesAt(x, y);
  const auto result = assemble(set, cellsOf(rowsOf(set)));
  ASSERT_TRUE(result.disputed.empty());
  EXPECT_EQ(broken(result.diagram), "");
  // Rounding puts the sites beside the circle, and decides.
  auto triangles = result.diagram.triangles;
  std::ranges::sort(triangles);
  EXPECT_EQ(triangles,
            (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 5}, {1, 2, 5}, {2, 3, 4}, {2, 4, 5}}));
  for (std::size_t i = 0; i < 6; ++i) {
    const auto neighbors = neighborsOf(result.diagram, i);
    const auto sites = std::count_if(neighbors.begin(), neighbors.end(), [](auto n) { return n >= 0; });
    EXPECT_EQ(sites, 2) << i;
  }
}

TEST(Cells, ofManyNeighborsAreCheckedAsOthers) {
  const int count = 200;
  std::vector<double> x{0.5}, y{0.5};
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.3) / count;
    x.push_back(0.5 + 0.4 * std::cos(angle));
    y.push_back(0.5 + 0.4 * std::sin(angle));
  }
  const auto set = sitesAt(x, y);
  auto rows = rowsOf(set);
  const auto result = assemble(set, cellsOf(rows));
  ASSERT_TRUE(result.disputed.empty());
  EXPECT_EQ(broken(result.diagram), "");
  EXPECT_EQ(neighborsOf(result.diagram, 0).size(), 200u);
  std::swap(rows[0][50], rows[0][90]);
  const auto wrong = assemble(set, cellsOf(rows));
  EXPECT_TRUE(std::binary_search(wrong.disputed.begin(), wrong.disputed.end(), 0u));
}

TEST(Cells, whereATieTouchesAWallStayOnTheWall) {
  // The center of the circle through the first three lies on the lower wall, but for rounding or a little.
  for (const double below : {0.0, 1e-9, 1e-16, -1e-16}) {
    const auto set = sitesAt({0.2, 0.5, 0.8}, {0.4, 0.5 + below, 0.4});
    const auto result = assemble(set, cellsOf(rowsOf(set)));
    ASSERT_TRUE(result.disputed.empty()) << below;
    EXPECT_EQ(broken(result.diagram), "") << below;
    EXPECT_EQ(neighborsOf(result.diagram, 1).size(), 3u) << below;
    for (const auto& v : result.diagram.vertices) {
      EXPECT_TRUE(v.y == 0 || v.y > 0.1);
    }
  }
}

TEST(Cells, haveShortEdgesAtWalls) {
  // The same center, so far beyond the wall that the cell of the second reaches it.
  const auto set = sitesAt({0.2, 0.5, 0.8}, {0.4, 0.5 - 1e-9, 0.4});
  const auto result = assemble(set, cellsOf(rowsOf(set)));
  ASSERT_TRUE(result.disputed.empty());
  EXPECT_EQ(broken(result.diagram), "");
  EXPECT_EQ(neighborsOf(result.diagram, 1).size(), 4u);
}

TEST(Cells, thatTouchTheDomainOnlyAreEmpty) {
  // The cell of the second is beyond the corner of the domain, or a speck of rounding inside it.
  const auto set = sitesAt({0.25, 1.75}, {0.25, 1.75});
  Rows rows{{wall_ymin, wall_xmax, 1, wall_ymax, wall_xmin}, {wall_xmax, wall_ymax, 0}};
  const auto result = assemble(set, cellsOf(rows));
  ASSERT_TRUE(result.disputed.empty());
  EXPECT_EQ(result.diagram.status[1], Status::empty);
  EXPECT_EQ(neighborsOf(result.diagram, 0), (Neighbors{wall_ymax, wall_xmin, wall_ymin, wall_xmax}));
  EXPECT_EQ(result.diagram.report.empty, 1u);
  EXPECT_EQ(broken(result.diagram), "");
}

TEST(Cells, keepTheirPrecisionFarFromTheOrigin) {
  auto set = jitteredSites(8, 0.5, 7);
  const auto here = assemble(set, cellsOf(rowsOf(set)));
  const auto rows = rowsOf(set);
  const double far = 0x1p24;
  for (auto& x : set.x) x = far + std::ldexp(std::floor(std::ldexp(x, 20)), -20);
  for (auto& y : set.y) y = far + std::ldexp(std::floor(std::ldexp(y, 20)), -20);
  set.domain = {far, far, far + 1, far + 1};
  const auto there = assemble(set, cellsOf(rows));
  for (auto& x : set.x) x -= far;
  for (auto& y : set.y) y -= far;
  set.domain = {0, 0, 1, 1};
  const auto moved = assemble(set, cellsOf(rows));
  ASSERT_TRUE(there.disputed.empty() && moved.disputed.empty() && here.disputed.empty());
  for (std::size_t i = 0; i < set.size(); ++i) {
    EXPECT_NEAR(there.diagram.area[i], moved.diagram.area[i], 1e-14 * moved.diagram.area[i]);
  }
}

}  // namespace
}  // namespace vorpipe::test
