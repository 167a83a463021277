#include "sites/tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "backend/registry/registry.h"
#include "cells/neighbor_search.h"
#include "sites/site_set.h"
#include "unit/fixtures/all_of.h"
#include "unit/fixtures/changed_cpu.h"

namespace vorpipe::test {

using namespace core;

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

SiteSet preparedSites(Pattern pattern, std::size_t count) {
  return prepare(generate(pattern, count, 1), {0, 0, 1, 1}, 1)->set;
}

/// The cpu, which refuses more sites or bins than it says it takes.
class Small final : public ChangedCpu {
 public:
  Small(std::uint64_t most_sites, std::uint64_t most_bins) : ChangedCpu(0), info_(ChangedCpu::info()) {
    info_.max_sites = most_sites;
    info_.max_bins = most_bins;
  }

  const BackendInfo& info() const override { return info_; }
  Result<void> upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index) override {
    ++uploads;
    EXPECT_LE(sites.size(), info_.max_sites);
    EXPECT_LE(sites.grid.offsets.size() - 1, info_.max_bins);
    return ChangedCpu::upload(sites, palette_index);
  }
  int uploads = 0;

 private:
  BackendInfo info_;
};

void expectEverySiteInOneTile(const SiteSet& sites, std::uint64_t most_sites, std::uint64_t most_bins) {
  BackendInfo info;
  info.max_sites = most_sites;
  info.max_bins = most_bins;
  std::vector<int> times(sites.size());
  const auto work = [&](const Tile& tile) -> Result<void> {
    EXPECT_LE(tile.sites.size(), most_sites);
    EXPECT_LE(tile.sites.grid.offsets.size() - 1, most_bins);
    EXPECT_TRUE(std::is_sorted(tile.own.begin(), tile.own.end()));
    for (const auto site : tile.own) {
      ++times[tile.wholeIndex(site)];
      EXPECT_EQ(tile.sites.id[site], sites.id[tile.wholeIndex(site)]);
    }
    return {};
  };
  const auto left = forTiles(sites, info, allOf(sites), 2, work);
  ASSERT_TRUE(left);
  for (const auto site : *left) ++times[site];
  for (std::size_t i = 0; i < times.size(); ++i) ASSERT_EQ(times[i], 1) << "site " << i;
}

TEST(Tiles, EverySiteIsInOne) {
  for (const auto pattern : {Pattern::random, Pattern::clusters, Pattern::circle}) {
    const auto sites = preparedSites(pattern, 20000);
    expectEverySiteInOneTile(sites, 3000, 1 << 20);
    expectEverySiteInOneTile(sites, 1 << 20, 900);
    expectEverySiteInOneTile(sites, 400, 200);
    expectEverySiteInOneTile(sites, 1 << 20, 1 << 20);
  }
}

TEST(Tiles, SitesThatNoTileHoldsAreLeft) {
  BackendInfo info;
  info.max_sites = 20;
  info.max_bins = 20;
  const auto sites = preparedSites(Pattern::random, 5000);
  const auto work = [](const Tile&) -> Result<void> {
    ADD_FAILURE() << "a tile with a halo has more than 20 bins";
    return {};
  };
  auto left = forTiles(sites, info, allOf(sites), 2, work);
  ASSERT_TRUE(left);
  std::sort(left->begin(), left->end());
  EXPECT_EQ(*left, allOf(sites));
}

TEST(Tiles, CrowdsAreLeft) {
  BackendInfo info;
  info.max_sites = info.max_bins = 1 << 20;
  const auto sites = preparedSites(Pattern::circle, 20000);
  const auto work = [](const Tile&) -> Result<void> {
    ADD_FAILURE() << "all of them are crowded";
    return {};
  };
  const auto left = forTiles(sites, info, allOf(sites), 2, work);
  ASSERT_TRUE(left);
  EXPECT_EQ(*left, allOf(sites));
}

TEST(Tiles, KnowTheirSites) {
  const auto sites = preparedSites(Pattern::random, 5000);
  std::vector<std::uint32_t> whole;
  const BinBlock block{3, 0, 12, 9};
  const auto tile = cutOut(sites, block, whole);
  EXPECT_EQ(tile.coverage.ymin, -unbounded);
  EXPECT_DOUBLE_EQ(tile.coverage.xmin, sites.grid.xmin + 3 * sites.grid.size);
  EXPECT_DOUBLE_EQ(tile.coverage.xmax, sites.grid.xmin + 13 * sites.grid.size);
  EXPECT_DOUBLE_EQ(tile.coverage.ymax, sites.grid.ymin + 10 * sites.grid.size);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const bool known = sites.x[i] >= tile.coverage.xmin && sites.x[i] <= tile.coverage.xmax &&
                       sites.y[i] >= tile.coverage.ymin && sites.y[i] <= tile.coverage.ymax;
    inside += known ? 1 : 0;
  }
  ASSERT_EQ(tile.size(), inside);
  for (std::size_t i = 0; i < tile.size(); ++i) {
    ASSERT_EQ(tile.x[i], sites.x[whole[i]]);
    ASSERT_EQ(tile.id[i], sites.id[whole[i]]);
    const auto bin = binOf(tile.grid, tile.x[i], tile.y[i]);
    ASSERT_TRUE(i >= tile.grid.offsets[bin] && i < tile.grid.offsets[bin + 1]);
  }
}

std::vector<std::vector<std::int32_t>> rowsIn(const NeighborRows& rows) {
  std::vector<std::vector<std::int32_t>> cells;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = rows.edges(i);
    cells.emplace_back(row.begin(), row.end());
  }
  return cells;
}

struct Found {
  std::vector<std::vector<std::int32_t>> cells;
  Report report;
  int uploads;
};

Found cellsInTiles(const SiteSet& sites, std::uint64_t most_sites, std::uint64_t most_bins) {
  Small backend(most_sites, most_bins);
  const auto exact = openExactTier(0);
  SiteMesh mesh(sites, 2);
  ExactSearch exact_search(*exact, mesh);
  const SearchOptions search;
  const Progress progress;
  Report report;
  const auto rows =
      findNeighbors({backend, exact_search, sites, search, 2, progress}, AtEmpty::ignore, report);
  EXPECT_TRUE(rows) << rows.error().message;
  return {rowsIn(**rows), report, backend.uploads};
}

TEST(Tiles, LeaveCrowdedCellsToTheTriangulation) {
  const auto sites = preparedSites(Pattern::clusters, 60000);
  constexpr std::uint64_t all = 1 << 20;
  const auto found = cellsInTiles(sites, all, all);
  const auto exact = openExactTier(0);
  SiteMesh mesh(sites, 2);
  ExactSearch exact_search(*exact, mesh);
  std::uint64_t exact_cells = 0;
  const auto judged = exact_search.find(allOf(sites), Precision::in_double, 2, {}, exact_cells);
  ASSERT_TRUE(judged);
  EXPECT_EQ(found.cells, rowsIn(*judged));
}

TEST(Tiles, GiveTheSameCells) {
  constexpr std::uint64_t all = 1 << 20;
  const auto sites = preparedSites(Pattern::random, 30000);
  const auto whole = cellsInTiles(sites, all, all);
  EXPECT_EQ(whole.uploads, 1);
  const auto few_sites = cellsInTiles(sites, 4000, all);
  EXPECT_GT(few_sites.uploads, 8);
  EXPECT_LT(few_sites.report.in_double, 600u) << "cells at the borders of tiles are found in the halo";
  EXPECT_EQ(few_sites.cells, whole.cells);
  const auto few_bins = cellsInTiles(sites, all, 2000);
  EXPECT_GT(few_bins.uploads, 8);
  EXPECT_EQ(few_bins.cells, whole.cells);
}

/// Spread sites, and more in a square of the given side.
SiteSet withCluster(std::size_t spread, std::size_t dense, double side) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  Sites sites;
  for (std::size_t i = 0; i < spread + dense; ++i) {
    const double scale = i < spread ? 1 : side;
    const double low = i < spread ? 0 : 0.3;
    sites.x.push_back(low + scale * uniform(random));
    sites.y.push_back(low + scale * uniform(random));
  }
  return prepare(sites, {0, 0, 1, 1}, 1)->set;
}

TEST(Crowds, EvenSitesAreInNone) {
  for (const Pattern pattern : {Pattern::random, Pattern::jitter, Pattern::square, Pattern::hex}) {
    const auto sites = prepare(generate(pattern, 20000, 1), {0, 0, 1, 1}, 1)->set;
    const auto crowds = sortByCrowds(sites.grid, allOf(sites), 2);
    EXPECT_LT(crowds.crowded.size(), sites.size() / 100);
    EXPECT_EQ(crowds.even.size() + crowds.crowded.size(), sites.size());
  }
}

TEST(Crowds, EverySiteIsSortedOnce) {
  for (const double side : {0.2, 1e-2, 1e-9}) {
    const auto sites = withCluster(20000, 5000, side);
    auto which = allOf(sites);
    for (const bool all : {true, false}) {
      if (!all) std::erase_if(which, [](std::uint32_t i) { return i % 3 == 0; });
      const auto crowds = sortByCrowds(sites.grid, which, 3);
      std::vector<std::uint32_t> both;
      std::ranges::merge(crowds.even, crowds.crowded, std::back_inserter(both));
      EXPECT_EQ(both, which);
    }
  }
}

TEST(Crowds, AreWhereManySitesAreInFewBins) {
  const auto sites = withCluster(20000, 500, 1e-3);
  const auto crowds = sortByCrowds(sites.grid, allOf(sites), 1);
  EXPECT_NEAR(static_cast<double>(crowds.crowded.size()), 500, 50);
  std::size_t inside = 0;
  for (const auto i : crowds.crowded)
    inside += std::abs(sites.x[i] - 0.3) < 0.1 && std::abs(sites.y[i] - 0.3) < 0.1;
  EXPECT_GE(inside, 500u);
}

TEST(Crowds, AreAllWhereTheyAreMany) {
  const auto sites = withCluster(10000, 8000, 1e-2);
  const auto crowds = sortByCrowds(sites.grid, allOf(sites), 1);
  EXPECT_TRUE(crowds.even.empty());
  EXPECT_EQ(crowds.crowded, allOf(sites));
}

}  // namespace
}  // namespace vorpipe::test
