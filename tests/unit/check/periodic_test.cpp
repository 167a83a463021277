#include <gmock/gmock.h>

#include <algorithm>

#include "unit/fixtures/periodic_runs.h"

namespace vorpipe::test {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;

/// The tests change the cells of a periodic domain, and see which promises are broken then.
class CheckPeriodicCells : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> broken() const {
    return promisesOf(check(sites, periodicCells(), cells));
  }
  Sites sites = generate(Pattern::random, 60, 12);
  Diagram cells = cellsOf(sites, periodicCells());
};

TEST_F(CheckPeriodicCells, FindsNothingInRightOnes) {
  EXPECT_THAT(broken(), IsEmpty());
  sites = mixedSites();
  for (const auto periodic : {Periodic::x, Periodic::y, Periodic::xy}) {
    const auto wanted = periodicCells(periodic);
    EXPECT_THAT(promisesOf(check(sites, wanted, cellsOf(sites, wanted))), IsEmpty());
  }
}

TEST_F(CheckPeriodicCells, TakesAnyImageThatDoubleDoesNotTellFromTheNearest) {
  for (const double apart : {1e-12, 1e-14, 1e-15}) {
    sites = {{0, 1 - apart}, {0.5, 0.5}, {}};
    for (const auto periodic : {Periodic::x, Periodic::xy}) {
      const auto wanted = periodicCells(periodic);
      EXPECT_THAT(promisesOf(check(sites, wanted, cellsOf(sites, wanted))), IsEmpty()) << apart;
    }
  }
}

TEST_F(CheckPeriodicCells, AllowsTiesAsLongAsThePeriod) {
  for (const auto periodic : {Periodic::x, Periodic::y, Periodic::xy}) {
    auto wanted = periodicCells(periodic);
    wanted.domain = {0, 0, 1, 1e-9};
    cells = cellsOf(sites, wanted);
    EXPECT_THAT(promisesOf(check(sites, wanted, cells)), IsEmpty());
    cells.area[std::size_t(std::ranges::find(cells.status, Status::ok) - cells.status.begin())] *= 1.001;
    EXPECT_THAT(promisesOf(check(sites, wanted, cells)), Contains("areas"));
  }
}

/// Sides that are few steps of a coordinate long are rounded by a part of themselves that shows.
TEST_F(CheckPeriodicCells, AllowsAPeriodToBeRounded) {
  for (const auto periodic : {Periodic::x, Periodic::y, Periodic::xy}) {
    auto wanted = periodicCells(periodic);
    wanted.domain = {0.9999999999989332, 0.5000000166933728, 1.000000000001067, 0.5000000166938298};
    sites = {{0.9999999999999}, {0.5}, {}};
    cells = cellsOf(sites, wanted);
    EXPECT_THAT(promisesOf(check(sites, wanted, cells)), IsEmpty());
    cells.area[0] *= 1.01;
    EXPECT_THAT(promisesOf(check(sites, wanted, cells)), Contains("areas"));
  }
}

TEST_F(CheckPeriodicCells, FindsOrdinaryOnes) {
  cells = cellsOf(sites, unit_cells);
  EXPECT_THAT(broken(), Contains("arrays"));
  cells.neighbor_shifts.resize(cells.neighbors.size());
  EXPECT_THAT(broken(), Contains("neighbors"));
}

TEST_F(CheckPeriodicCells, FindsWrongShifts) {
  for (std::size_t e = 0; e < cells.neighbors.size(); e += 17) {
    const auto right = cells;
    cells.neighbor_shifts[e][e % 2] += 1;
    EXPECT_THAT(broken(), Contains("symmetry")) << "edge " << e;
    cells = right;
  }
  cells.neighbor_shifts.pop_back();
  EXPECT_THAT(broken(), Contains("arrays"));
}

TEST_F(CheckPeriodicCells, FindsShiftsAlongTheOtherAxis) {
  const auto x = periodicCells(Periodic::x);
  cells = cellsOf(sites, x);
  const auto wall = std::ranges::find(cells.neighbors, wall_ymin) - cells.neighbors.begin();
  cells.neighbors[static_cast<std::size_t>(wall)] = wall_xmin;
  EXPECT_THAT(promisesOf(check(sites, x, cells)), Contains("neighbors"));
}

TEST_F(CheckPeriodicCells, FindsCellsOfOtherSites) {
  for (double& x : sites.x) x = 1 - x;
  EXPECT_THAT(broken(), Contains("nearest sites"));
}

TEST_F(CheckPeriodicCells, FindsMovedVerticesAndWrongAreas) {
  const auto right = cells;
  cells.vertices[40].x += 1e-6;
  EXPECT_THAT(broken(), Contains("symmetry"));
  cells = right;
  cells.area[7] *= 1 + 1e-8;
  EXPECT_THAT(broken(), Contains("areas"));
}

TEST(DiffPeriodicIds, KnowsBisectorsAcrossTheBorder) {
  // Sites at 0.1 and 0.8 meet at 0.45 and, across the border, at 0.95: the center of column 9 of 10.
  const Sites sites{{0.1, 0.8}, {0.5, 0.5}, {}};
  std::vector<std::uint32_t> a(100), b(100);
  for (std::size_t pixel = 0; pixel < 100; ++pixel) {
    const auto column = pixel % 10;
    a[pixel] = column < 5 || column == 9 ? 0 : 1;
    b[pixel] = column < 5 ? 0 : 1;
  }
  const auto periodic = diffIds(a, b, 10, 10, sites, unit, Periodic::x);
  ASSERT_TRUE(periodic);
  EXPECT_EQ(periodic->ties, 10u);
  EXPECT_TRUE(periodic->agree());
  EXPECT_EQ(diffIds(a, b, 10, 10, sites, unit)->wrong, 10u);
  EXPECT_EQ(diffIds(a, b, 10, 10, sites, unit, Periodic::y)->wrong, 10u);
  b[3] = 1;
  EXPECT_EQ(diffIds(a, b, 10, 10, sites, unit, Periodic::x)->wrong, 1u);
}

TEST(DiffPeriodicCells, TellsImagesOfANeighborApart) {
  const auto sites = generate(Pattern::random, 20, 1);
  const auto a = cellsOf(sites, periodicCells());
  auto b = a;
  EXPECT_TRUE(diffCells(a, b)->agree());
  b.neighbor_shifts[5][1] += 1;
  EXPECT_EQ(diffCells(a, b)->neighbors, 1u);
}

}  // namespace
}  // namespace vorpipe::test
