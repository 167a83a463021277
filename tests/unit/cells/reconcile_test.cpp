/// Cells that agree, and cells that do not.
#include <gtest/gtest.h>

#include <cstring>

#include "geometry/triangulation.h"
#include "unit/cells/agreed_cells.h"

namespace vorpipe::test {

using namespace core;

namespace {

TEST(Cells, ofTwoSitesMeetTheWalls) {
  const auto set = sitesAt({0.25, 0.75}, {0.5, 0.5});
  const auto result =
      assemble(set, cellsOf({{wall_ymin, 1, wall_ymax, wall_xmin}, {wall_ymin, wall_xmax, wall_ymax, 0}}));
  ASSERT_TRUE(result.disputed.empty());
  const auto& d = result.diagram;
  EXPECT_EQ(broken(d), "");
  EXPECT_EQ(neighborsOf(d, 0), (Neighbors{wall_ymax, wall_xmin, wall_ymin, 1}));
  const std::vector<std::pair<double, double>> corners{{0.5, 1}, {0, 1}, {0, 0}, {0.5, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(d.vertices[k].x, corners[k].first);
    EXPECT_EQ(d.vertices[k].y, corners[k].second);
  }
  EXPECT_EQ(d.area[0], 0.5);
  EXPECT_EQ(d.centroid[1].x, 0.75);
  EXPECT_EQ(d.edge_lengths[3], 1);
  EXPECT_EQ(d.perimeter[0], 3);
  EXPECT_TRUE(d.triangles.empty());
}

TEST(Cells, ofASingleSiteAreTheDomain) {
  const auto result =
      assemble(sitesAt({0.2}, {0.9}), cellsOf({{wall_xmax, wall_ymax, wall_xmin, wall_ymin}}));
  ASSERT_TRUE(result.disputed.empty());
  EXPECT_DOUBLE_EQ(result.diagram.area[0], 1);
  EXPECT_EQ(neighborsOf(result.diagram, 0), (Neighbors{wall_ymax, wall_xmin, wall_ymin, wall_xmax}));
}

TEST(Cells, passAsTheyAreWithoutTies) {
  const auto set = jitteredSites(12, 0.5);
  const auto rows = rowsOf(set);
  const auto result = assemble(set, cellsOf(rows));
  ASSERT_TRUE(result.disputed.empty());
  EXPECT_EQ(result.suspect, 0u);
  EXPECT_EQ(broken(result.diagram), "");
  for (std::size_t i = 0; i < set.size(); ++i) {
    Neighbors expected;
    for (const auto n : rows[i]) {
      expected.push_back(n < 0 ? std::int64_t{n} : std::int64_t{set.id[static_cast<std::size_t>(n)]});
    }
    EXPECT_EQ(fromLowest(neighborsOf(result.diagram, set.id[i])), fromLowest(expected));
  }
}

TEST(Cells, keepTheirBitsWhateverThreadsAndDetail) {
  const std::size_t side = 80;
  for (const double jitter : {0.0, 0.4}) {
    const auto set = jitteredSites(side, jitter);
    const auto cells = cellsOf(rowsOfJittered(set, side));
    const auto one = assemble(set, cells, 1);
    ASSERT_TRUE(one.disputed.empty());
    EXPECT_EQ(broken(one.diagram), "");
    const auto same = [](const auto& a, const auto& b) {
      return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
    };
    for (const int threads : {2, 3, 8}) {
      const auto many = assemble(set, cells, threads);
      EXPECT_TRUE(same(one.diagram.area, many.diagram.area));
      EXPECT_TRUE(same(one.diagram.centroid, many.diagram.centroid));
      EXPECT_TRUE(same(one.diagram.vertices, many.diagram.vertices));
      EXPECT_TRUE(same(one.diagram.neighbors, many.diagram.neighbors));
      EXPECT_TRUE(same(one.diagram.edge_lengths, many.diagram.edge_lengths));
      EXPECT_TRUE(same(one.diagram.second_moments, many.diagram.second_moments));
      EXPECT_TRUE(same(one.diagram.triangles, many.diagram.triangles));
    }
    const auto measures = assemble(set, cells, 2, Detail::measures).diagram;
    EXPECT_TRUE(same(one.diagram.area, measures.area));
    EXPECT_TRUE(same(one.diagram.neighbors, measures.neighbors));
    EXPECT_TRUE(measures.vertices.empty() && measures.edge_lengths.empty() && measures.perimeter.empty() &&
                measures.second_moments.empty() && measures.triangles.empty());
  }
}

/// The triangulation of all sites as exact decisions alone give it.
Triangles exactTriangles(const SiteSet& set) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < set.size(); ++i) points.push_back({set.x[i], set.y[i]});
  Triangles triangles;
  for (const auto& t : delaunay(points).triangles) {
    if (std::find(t.corner.begin(), t.corner.end(), ghost) != t.corner.end()) continue;
    Triangles::value_type ids{};
    for (std::size_t k = 0; k < 3; ++k) ids[k] = set.id[static_cast<std::size_t>(t.corner[k])];
    std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
    triangles.push_back(ids);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(Cells, areDualToTheTrianglesOfAllSitesWhateverTheDomain) {
  const auto set = jitteredSites(14, 0.5, 9);
  const auto exact = exactTriangles(set);
  for (const Box domain : {Box{0, 0, 1, 1}, Box{-50, -80, 20, 30}, Box{0.3, 0.4, 0.7, 0.6},
                           Box{0.5, 0.5, 0.51, 0.51}, Box{2, 0, 3, 1}, Box{0.2, -1, 0.21, 2}}) {
    auto cropped = set;
    cropped.domain = domain;
    auto result = assemble(cropped, cellsOf(rowsOf(cropped)));
    ASSERT_TRUE(result.disputed.empty());
    std::sort(result.diagram.triangles.begin(), result.diagram.triangles.end());
    EXPECT_EQ(result.diagram.triangles, exact);
  }
}

/// Another search begins cells elsewhere, and sees other ties.
TEST(Cells, areTheSameBitsWhereverTheirEdgesBegin) {
  for (const double jitter : {0.0, 0.3}) {
    const auto set = jitteredSites(11, jitter, 5);
    const auto rows = rowsOf(set);
    auto turned = rows;
    for (std::size_t i = 0; i < turned.size(); ++i) {
      std::rotate(turned[i].begin(), turned[i].begin() + static_cast<std::ptrdiff_t>(i % turned[i].size()),
                  turned[i].end());
    }
    const auto a = assemble(set, cellsOf(rows)).diagram, b = assemble(set, cellsOf(turned)).diagram;
    EXPECT_EQ(a.area, b.area);
    EXPECT_EQ(a.perimeter, b.perimeter);
    EXPECT_EQ(a.neighbors, b.neighbors);
    EXPECT_EQ(a.triangles, b.triangles);
    for (std::size_t v = 0; v < a.vertices.size(); ++v) {
      EXPECT_EQ(a.vertices[v].x, b.vertices[v].x);
      EXPECT_EQ(a.vertices[v].y, b.vertices[v].y);
    }
  }
}

class WrongCells : public testing::Test {
 protected:
  void expectDisputed(const Rows& wrong, std::initializer_list<std::int32_t> culprits) {
    for (const int threads : {1, 4}) {
      const auto result = assemble(set, cellsOf(wrong), threads);
      for (const auto i : culprits) {
        EXPECT_TRUE(std::binary_search(result.disputed.begin(), result.disputed.end(), i)) << i;
      }
      EXPECT_LE(result.disputed.size(), 16u);
    }
  }
  /// A cell without walls, in the middle.
  static constexpr std::int32_t cell = 78;
  const SiteSet set = jitteredSites(12, 0.4);
  const Rows rows = rowsOf(set);
};

TEST_F(WrongCells, thatMissANeighborAreDisputed) {
  for (std::size_t e = 0; e < rows[cell].size(); ++e) {
    auto wrong = rows;
    wrong[cell].erase(wrong[cell].begin() + static_cast<std::ptrdiff_t>(e));
    expectDisputed(wrong, {cell, rows[cell][e]});
  }
}

TEST_F(WrongCells, thatSwapNeighborsAreDisputed) {
  for (std::size_t e = 0; e < rows[cell].size(); ++e) {
    auto wrong = rows;
    std::swap(wrong[cell][e], wrong[cell][(e + 1) % rows[cell].size()]);
    expectDisputed(wrong, {cell});
  }
}

TEST_F(WrongCells, thatRunClockwiseAreDisputed) {
  auto wrong = rows;
  std::reverse(wrong[cell].begin(), wrong[cell].end());
  expectDisputed(wrong, {cell});
}

/// All four cells agree on the diagonal that is not Delaunay.
TEST_F(WrongCells, aroundAFlippedDiagonalAreDisputed) {
  const auto remove = [](auto& row, std::int32_t n) { row.erase(std::find(row.begin(), row.end(), n)); };
  const auto insertBefore = [](auto& row, std::int32_t next, std::int32_t n) {
    row.insert(std::find(row.begin(), row.end(), next), n);
  };
  for (std::size_t e = 0; e < rows[cell].size(); ++e) {
    const auto size = rows[cell].size();
    const auto p = rows[cell][(e + size - 1) % size], other = rows[cell][e], q = rows[cell][(e + 1) % size];
    auto wrong = rows;
    remove(wrong[cell], other);
    remove(wrong[static_cast<std::size_t>(other)], cell);
    // Counter-clockwise, p sees the other before the cell, and q the cell before the other.
    insertBefore(wrong[static_cast<std::size_t>(p)], cell, q);
    insertBefore(wrong[static_cast<std::size_t>(q)], other, p);
    expectDisputed(wrong, {cell});
  }
}

TEST_F(WrongCells, thatAreNoCellsAreDisputed) {
  for (const auto& row : {std::vector<std::int32_t>{},
                          {wall_xmin, wall_xmax},
                          {wall_xmin, cell, wall_xmax},
                          {wall_xmin, 1000, wall_ymax},
                          {wall_xmin, -5, wall_ymax}}) {
    auto wrong = rows;
    wrong[cell] = row;
    expectDisputed(wrong, {cell});
  }
  auto cells = cellsOf(rows);
  cells.status[cell] = CellStatus::missing;
  const auto disputed = assemble(set, cells).disputed;
  EXPECT_TRUE(std::binary_search(disputed.begin(), disputed.end(), cell));
}

TEST_F(WrongCells, withAWallInTheMiddleAreDisputed) {
  auto wrong = rows;
  wrong[cell][0] = wall_ymin;
  expectDisputed(wrong, {cell, rows[cell][0]});
}

}  // namespace
}  // namespace vorpipe::test
