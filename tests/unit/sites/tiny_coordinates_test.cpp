/// Coordinates that are not 0 but as good as that: sites on an axis, as a program that rounds may have them.
#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "sites/site_set.h"
#include "support/sites/random_sites.h"
#include "unit/fixtures/periodic_runs.h"

namespace vorpipe::test {

using namespace core;

namespace {

using ::testing::IsEmpty;

constexpr double least_double = 5e-324;

/// Sites on the walls of the unit square, or the least step beside them, with weights that hide many.
Sites besideWalls(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Sites sites;
  for (std::size_t i = 0; i < count; ++i) {
    constexpr std::array<double, 4> beside{least_double, -least_double, 0, 1};
    const double wall = beside[random.below(beside.size())], along = random.uniform();
    if (i % 3 == 0) {
      add(sites, {wall, along});
    } else if (i % 3 == 1) {
      add(sites, {along, wall});
    } else {
      add(sites, {along, random.uniform()});
    }
    sites.weight.push_back(0.01 * random.uniform());
  }
  return sites;
}

TEST(TinyCoordinates, HaveTheCellsOfZero) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
    SCOPED_TRACE(seed);
    const auto sites = besideWalls(120, seed);
    const auto cells = cellsOf(sites, unit_cells);
    EXPECT_THAT(promisesOf(check(sites, unit_cells, cells)), IsEmpty());
    auto plain = sites;
    for (auto* coordinates : {&plain.x, &plain.y}) {
      for (double& value : *coordinates) value = std::abs(value) < 1e-300 ? 0 : value;
    }
    const auto of_plain = cellsOf(plain, unit_cells);
    EXPECT_EQ(cells.status, of_plain.status);
    EXPECT_EQ(cells.area, of_plain.area);
    EXPECT_EQ(cells.neighbors, of_plain.neighbors);
    EXPECT_EQ(cells.triangles, of_plain.triangles);
  }
}

TEST(TinyCoordinates, AreMultiplesOfTheLeast) {
  const auto prepared = prepare({{0.25, 0.5, 0.75}, {least_double, 1e-100, 1e-58}, {}}, unit, 1);
  ASSERT_TRUE(prepared) << prepared.error().message;
  EXPECT_EQ(prepared->set.y, (std::vector<double>{0, 0, 80 * 0x1p-199}));
}

/// In a periodic domain coordinates are rounded, and sites that are one by that are duplicates.
TEST(TinyCoordinates, AreOneInAPeriodicDomain) {
  const Sites sites{{0.25, 0.25, 0.25, 0.5}, {least_double, 0, -1e-100, 1e-58}, {}};
  for (const auto periodic : {Periodic::x, Periodic::y, Periodic::xy}) {
    const auto options = periodicCells(periodic);
    const auto cells = cellsOf(sites, options);
    EXPECT_EQ(cells.report.duplicate, 2u);
    EXPECT_THAT(promisesOf(check(sites, options, cells)), IsEmpty());
  }
}

TEST(TinyCoordinates, StayInTheRecordOfASiteWithoutACell) {
  const Sites sites{{0.5, 0.5, 2}, {0.5, 1, least_double}, {1, 0, 0}};
  const auto cells = cellsOf(sites, unit_cells);
  ASSERT_EQ(cells.status[2], Status::empty);
  EXPECT_EQ(cells.centroid[2], (Point{2, least_double}));
  EXPECT_THAT(promisesOf(check(sites, unit_cells, cells)), IsEmpty());
}

}  // namespace
}  // namespace vorpipe::test
