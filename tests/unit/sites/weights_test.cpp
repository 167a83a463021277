/// Weights on their way into a SiteSet and its parts, and proofs that sites are hidden.
#include "sites/weights.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "cells/hidden_cells.h"
#include "geometry/vertex_position.h"
#include "sites/bin_sort.h"
#include "sites/site_set.h"
#include "sites/tiles.h"
#include "support/sites/random_sites.h"
#include "support/sites/unit.h"
#include "unit/fixtures/brute_force.h"
#include "unit/fixtures/proposed_cells.h"

namespace vorpipe::test {

using namespace core;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Sites weightedSites(std::size_t count, double most) {
  auto sites = generate(Pattern::random, count, 1);
  Random random(3);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites.weight.push_back(most / static_cast<double>(count) * random.uniform());
  }
  return sites;
}

SiteSet prepared(const Sites& sites, const Box& domain = unit) {
  auto made = prepare(sites, domain, 2);
  EXPECT_TRUE(made) << made.error().message;
  return std::move(made->set);
}

std::string refusal(const Sites& sites, const Box& domain = unit) {
  const auto made = prepare(sites, domain, 2);
  return made ? "" : made.error().message;
}

TEST(ScaledWeights, standBesideTheirSitesInScaledUnits) {
  auto sites = weightedSites(1000, 50);
  for (auto& x : sites.x) x *= 8;
  for (auto& weight : sites.weight) weight *= 64;
  const auto set = prepared(sites, {0, 0, 8, 1});
  ASSERT_EQ(set.weight.size(), set.size());
  for (std::size_t i = 1; i < set.size(); ++i) {
    ASSERT_EQ((set.weight[i] - set.weight[0]) * 64, sites.weight[set.id[i]] - sites.weight[set.id[0]]);
  }
}

TEST(ScaledWeights, areAsWithoutAnythingAddedToAll) {
  auto sites = weightedSites(1000, 50);
  for (auto& weight : sites.weight) weight = std::floor(weight * 0x1p20) * 0x1p-20;
  const auto set = prepared(sites);
  for (const double more : {1e6, -1e6, 0x1p30, 0.5}) {
    auto moved = sites;
    for (auto& weight : moved.weight) weight += more;
    EXPECT_EQ(prepared(moved).weight, set.weight);
    EXPECT_EQ(prepared(moved).grid.heaviest, set.grid.heaviest);
  }
}

TEST(ScaledWeights, areNotRounded) {
  auto sites = weightedSites(100, 50);
  sites.weight[7] = -1e9;
  const auto set = prepared(sites);
  for (std::size_t i = 0; i < set.size(); ++i) ASSERT_EQ(set.weight[i], sites.weight[set.id[i]]);
}

TEST(ScaledWeights, thatAreEqualAreNone) {
  auto sites = generate(Pattern::random, 100, 1);
  sites.weight.assign(100, 1e9 / 3);
  const auto set = prepared(sites);
  EXPECT_TRUE(set.weight.empty() && set.heavy.empty() && set.grid.heaviest.empty());
  sites.x[5] = sites.x[4];
  sites.y[5] = sites.y[4];
  sites.weight[5] = 0;
  EXPECT_TRUE(prepared(sites).weight.empty()) << "only that of a duplicate differs";
}

TEST(ScaledWeights, thatAreUnusableAreRefused) {
  auto sites = generate(Pattern::random, 3, 1);
  for (const double weight : {infinite, -infinite, std::nan("")}) {
    sites.weight = {0, weight, 1};
    EXPECT_TRUE(refusal(sites).starts_with("the weight of site 1 is not finite: ")) << refusal(sites);
  }
  sites.weight = {0, 1, 1e181};
  EXPECT_EQ(refusal(sites), "the weight of site 2 is too large for the domain: 1e+181");
  EXPECT_EQ(refusal(sites, {0, 0, 1e5, 1e5}), "");
  sites.weight = {0, 1, 1e-20};
  EXPECT_NE(refusal(sites, {0, 0, 1e-120, 1e-120}), "");
  sites.weight.pop_back();
  EXPECT_NE(refusal(sites), "");
}

TEST(ScaledWeights, decideWhichDuplicateOwnsThePosition) {
  for (const std::size_t others : {1u, 60u}) {  // the latter sorts its crowd
    Sites sites = generate(Pattern::random, 200, 1);
    Random random(5);
    for (std::size_t k = 0; k < others; ++k) {
      sites.x.insert(sites.x.end(), {sites.x[3], sites.x[4]});
      sites.y.insert(sites.y.end(), {sites.y[3], sites.y[4]});
    }
    for (std::size_t i = 0; i < sites.size(); ++i)
      sites.weight.push_back(static_cast<double>(random.below(4)));
    const auto made = prepare(sites, unit, 2);
    ASSERT_TRUE(made);
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
      std::uint32_t best = i;
      for (std::uint32_t j = 0; j < sites.size(); ++j) {
        if (sites.x[j] != sites.x[i] || sites.y[j] != sites.y[i]) continue;
        const double more = sites.weight[j] - sites.weight[best];
        if (more > 0 || (more == 0 && j < best)) best = j;
      }
      ASSERT_EQ(made->owner[i], best) << i;
    }
    for (std::size_t i = 0; i < made->set.size(); ++i)
      ASSERT_EQ(made->owner[made->set.id[i]], made->set.id[i]);
  }
}

TEST(HeavySites, areFewAndFarHeavierThanTheOthers) {
  auto sites = weightedSites(5000, 100);
  EXPECT_TRUE(prepared(sites).heavy.empty()) << "many sites are nearly as heavy as the heaviest";
  sites.weight[17] = 0.5;
  sites.weight[99] = 2;
  auto set = prepared(sites);
  ASSERT_EQ(set.heavy.size(), 2u);
  EXPECT_EQ(set.id[set.heavy[0]], 99u);
  EXPECT_EQ(set.id[set.heavy[1]], 17u);
  EXPECT_LT(set.grid.heaviest.back(), 0.5);
  for (std::size_t i = 0; i < 5000; i += 2) sites.weight[i] = 2 + 1e-3 * static_cast<double>(i);
  EXPECT_LE(prepared(sites).heavy.size(), most_heavy);
  sites = weightedSites(3, 1);
  sites.weight[0] = 1e9;
  EXPECT_EQ(prepared(sites).heavy.size(), 1u);
}

/// The largest weight, but for heavy sites, of the whole set's sites that stand in a block of a grid's bins,
/// or would stand there.
double heaviestByBruteForce(const SiteSet& whole, const Grid& grid, const BinBlock& block) {
  double heaviest = -infinite;
  for (std::uint32_t i = 0; i < whole.size(); ++i) {
    if (std::find(whole.heavy.begin(), whole.heavy.end(), i) != whole.heavy.end()) continue;
    const auto bin = binOf(grid, whole.x[i], whole.y[i]);
    const auto column = bin % grid.columns, row = bin / grid.columns;
    const bool is_in =
        column >= block.west && column <= block.east && row >= block.south && row <= block.north;
    if (is_in) heaviest = std::max(heaviest, whole.weight[i]);
  }
  return heaviest;
}

TEST(Heaviest, isOfBinsAndOfTwoByTwoAndOfAll) {
  auto sites = weightedSites(700, 10);
  sites.weight[3] = 5;
  const auto set = prepared(sites, {0, 0, 1, 0.6});
  const auto& grid = set.grid;
  std::size_t at = 0;
  for (std::uint32_t level = 0, step = 1;; ++level, step *= 2) {
    const auto columns = (grid.columns + step - 1) / step, rows = (grid.rows + step - 1) / step;
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t column = 0; column < columns; ++column) {
        const BinBlock block{column * step, row * step, (column + 1) * step - 1, (row + 1) * step - 1};
        ASSERT_EQ(grid.heaviest[at++], heaviestByBruteForce(set, grid, block)) << level;
      }
    }
    if (columns == 1 && rows == 1) break;
  }
  EXPECT_EQ(at, grid.heaviest.size());
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random.below(n)); };
    BinBlock block{below(grid.columns), below(grid.rows), below(grid.columns), below(grid.rows)};
    if (block.west > block.east) std::swap(block.west, block.east);
    if (block.south > block.north) std::swap(block.south, block.north);
    ASSERT_EQ(heaviestIn(grid, block), heaviestByBruteForce(set, grid, block));
  }
}

/// What a search in a part relies on: the heavy sites are there, and no site of the whole set is heavier than
/// the bin of the part's grid says in which it would stand, unless the part knows it to be elsewhere.
void expectSound(const SiteSet& whole, const SiteSet& part, const std::vector<std::uint32_t>& index) {
  ASSERT_EQ(part.weight.size(), part.size());
  ASSERT_EQ(part.heavy.size(), whole.heavy.size());
  for (std::size_t k = 0; k < part.heavy.size(); ++k) ASSERT_EQ(index[part.heavy[k]], whole.heavy[k]);
  for (std::size_t i = 0; i < part.size(); ++i) {
    ASSERT_EQ(part.id[i], whole.id[index[i]]);
    ASSERT_EQ(part.weight[i], whole.weight[index[i]]);
  }
  const auto& grid = part.grid;
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const BinBlock bin{column, row, column, row};
      ASSERT_GE(grid.heaviest[std::size_t{row} * grid.columns + column],
                heaviestByBruteForce(whole, grid, bin));
    }
  }
  EXPECT_EQ(grid.heaviest.back(), heaviestIn(grid, {0, 0, grid.columns - 1, grid.rows - 1}));
  EXPECT_GE(grid.heaviest.back(), heaviestByBruteForce(whole, grid, {0, 0, grid.columns - 1, grid.rows - 1}));
}

TEST(Heaviest, ofAPartCountsWhatIsBeyond) {
  auto sites = weightedSites(2500, 10);
  for (std::size_t i = 500; i < 2500; ++i)
    sites.x[i] = 0.4 + 0.01 * sites.x[i], sites.y[i] = 0.01 * sites.y[i];
  sites.weight[3] = 5;
  sites.weight[9] = 4;
  const auto set = prepared(sites);
  ASSERT_EQ(set.heavy.size(), 2u);
  const auto east = set.grid.columns - 1, north = set.grid.rows - 1;
  for (const BinBlock block : {BinBlock{5, 5, 12, 9}, BinBlock{0, 3, 4, 8}, BinBlock{3, 0, east, 4},
                               BinBlock{east - 3, north - 5, east, north}, BinBlock{0, 0, east, north}}) {
    std::vector<std::uint32_t> index;
    const auto tile = cutOut(set, block, index);
    expectSound(set, tile, index);
    const BinBlock inner{1, 1, tile.grid.columns - 1, 2};
    std::vector<std::uint32_t> in_tile;
    const auto tile_of_tile = cutOut(tile, inner, in_tile);
    for (auto& i : in_tile) i = index[i];
    expectSound(set, tile_of_tile, in_tile);
  }
}

}  // namespace
}  // namespace vorpipe::test
