#include <gmock/gmock.h>

#include <algorithm>

#include "unit/fixtures/checked_runs.h"

namespace vorpipe::test {
namespace {

class DiffCells : public ::testing::Test {
 protected:
  static const Diagram& rightCells() {
    static const Diagram right = cellsOf(mixedSites(), unit_cells);
    return right;
  }
  [[nodiscard]] CellsDiff diff() const { return *diffCells(rightCells(), cells); }

  Diagram cells = rightCells();
};

TEST_F(DiffCells, FindsNothingInEqualOnes) {
  const CellsDiff found = diff();
  EXPECT_TRUE(found.agree());
  EXPECT_EQ(found.equal, cells.status.size());
  EXPECT_EQ(found.worst_area, 0);
  EXPECT_TRUE(found.first.empty());
}

TEST_F(DiffCells, LetsACellBeginAnywhere) {
  const auto begin = cells.neighbors.begin() + static_cast<std::ptrdiff_t>(cells.cell_offsets[4]);
  const auto end = cells.neighbors.begin() + static_cast<std::ptrdiff_t>(cells.cell_offsets[5]);
  std::rotate(begin, begin + 1, end);
  EXPECT_TRUE(diff().agree());
}

TEST_F(DiffCells, FindsStatusesAndOwners) {
  cells.status[3] = Status::empty;
  cells.owner[200] = 6;
  const CellsDiff found = diff();
  EXPECT_FALSE(found.agree());
  EXPECT_EQ(found.statuses, 2u);
  ASSERT_EQ(found.first.size(), 2u);
  EXPECT_EQ(found.first[0].site, 3u);
  EXPECT_TRUE(found.first[1].status);
  EXPECT_FALSE(found.first[1].neighbors || found.first[1].area);
}

TEST_F(DiffCells, FindsNeighbors) {
  cells.neighbors[cells.cell_offsets[9]] = 50;
  EXPECT_EQ(diff().neighbors, 1u);
  cells = rightCells();
  const auto wall = std::ranges::find_if(cells.neighbors, [](std::int64_t n) { return n < 0; });
  *wall = *wall == wall_xmin ? wall_xmax : wall_xmin;
  EXPECT_EQ(diff().neighbors, 1u);
  cells = rightCells();
  cells.neighbors.pop_back();
  for (std::size_t i = 10; i < cells.cell_offsets.size(); ++i) --cells.cell_offsets[i];
  EXPECT_FALSE(diff().agree());
}

TEST_F(DiffCells, AllowsWhatIsPromisedOfAreas) {
  cells.area[9] *= 1 + 0.99e-5;
  EXPECT_TRUE(diff().agree());
  EXPECT_EQ(diff().worst_site, 9u);
  EXPECT_NEAR(diff().worst_area, 0.99, 0.01);
  cells.area[9] *= 1 + 0.05e-5;
  EXPECT_EQ(diff().areas, 1u);
  EXPECT_GT(diff().worst_area, 1);
  cells = rightCells();
  const double mean = 1.0 / static_cast<double>(cells.report.ok);
  cells.area[202] = 0.9e-9 * mean;
  EXPECT_TRUE(diff().agree());
  cells.area[202] = 1.2e-9 * mean;
  EXPECT_FALSE(diff().agree());
  cells.area[202] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(diff().agree());
  EXPECT_EQ(diff().worst_site, 202u);
}

TEST_F(DiffCells, KeepsTheFirstTen) {
  for (double& area : cells.area) area *= 2;
  EXPECT_EQ(diff().areas, 202u - 1);
  ASSERT_EQ(diff().first.size(), 10u);
  EXPECT_EQ(diff().first[9].site, 9u);
}

TEST_F(DiffCells, RefusesCellsOfOtherSites) { EXPECT_FALSE(diffCells(cells, Diagram{})); }

}  // namespace
}  // namespace vorpipe::test
