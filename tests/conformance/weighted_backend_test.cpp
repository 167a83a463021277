/// What every backend promises of sites with weights, by name: their cells and pictures through the interface
/// alone, against brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "backend/registry/registry.h"
#include "conformance/backend_scene.h"
#include "sites/weights.h"
#include "support/devices/backends.h"
#include "support/shared.h"
#include "support/sites/random_sites.h"
#include "unit/fixtures/brute_force.h"

namespace vorpipe::test {

using namespace core;

namespace {

struct Weighted {
  std::string name;
  SiteSet set;
};

// The set of these sites in the unit square, with a weight for each, by index; the `heavy` heaviest are
// listed.
template <class Weigh>
SiteSet weighted(const Sites& sites, std::size_t heavy, const Weigh& weigh) {
  SiteSet set = prepared(sites);
  for (std::size_t i = 0; i < set.size(); i++) set.weight.push_back(weigh(set.id[i]));
  const double least = *std::ranges::min_element(set.weight);
  for (double& weight : set.weight) weight -= least;
  std::vector<std::uint32_t> order = range(0, set.size());
  std::ranges::sort(order, [&](auto a, auto b) { return set.weight[a] > set.weight[b]; });
  set.heavy.assign(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(heavy));
  noteHeaviest(set, 1);
  buildPyramid(set.grid);
  return set;
}

// Weights up to `most`, in squares of the mean spacing.
SiteSet noise(Pattern pattern, std::size_t count, double most, std::size_t heavy = 0) {
  Random random(5);
  return weighted(generate(pattern, count, 9), heavy,
                  [&](std::uint32_t) { return most * random.uniform() / static_cast<double>(count); });
}

// Some sites are far heavier than all others.
SiteSet withHeavy(std::size_t count, std::size_t heavy, std::size_t listed) {
  Random random(3);
  return weighted(generate(Pattern::random, count, 4), listed, [&](std::uint32_t id) {
    return id < heavy ? 0.01 + 0.05 * random.uniform() : random.uniform() / static_cast<double>(count);
  });
}

// The cell of a site far beyond the domain has a part of it.
SiteSet withOneFarAway(std::size_t count) {
  Sites sites = generate(Pattern::random, count, 4);
  sites.x.push_back(51);
  sites.y.push_back(0.4);
  return weighted(sites, 1, [&](std::uint32_t id) { return id == count ? 50.2 * 50.2 : 0; });
}

std::vector<Weighted> someSets() {
  std::vector<Weighted> sets;
  for (const double most : {0.01, 1.0, 10.0, 100.0, 1e5}) {
    sets.push_back({"noise up to " + std::to_string(most), noise(Pattern::random, 250, most)});
  }
  sets.push_back({"two", noise(Pattern::random, 2, 0.5)});
  sets.push_back({"clusters", noise(Pattern::clusters, 250, 0.3)});
  sets.push_back({"lattice", noise(Pattern::square, 256, 2)});
  sets.push_back({"heavy sites, listed", withHeavy(300, 10, 10)});
  sets.push_back({"heavy sites, some listed", withHeavy(300, 20, 9)});
  sets.push_back({"heavy sites, not listed", withHeavy(300, 3, 0)});
  sets.push_back({"all but one listed", noise(Pattern::random, 33, 30, 32)});
  sets.push_back({"one swallows all", weighted(generate(Pattern::random, 200, 4), 1,
                                               [](std::uint32_t id) { return id == 7 ? 1e3 : 0.001; })});
  sets.push_back({"a heavy one far away", withOneFarAway(400)});
  // Far from their sites.
  sets.push_back({"a slope", weighted(generate(Pattern::random, 300, 6), 0,
                                      [sites = generate(Pattern::random, 300, 6)](std::uint32_t id) {
                                        return 0.5 * sites.x[id];
                                      })});
  return sets;
}

class WeightedBackend : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { SKIP_UNUSABLE(GetParam()); }

  // One for all tests of a process.
  static Backend& backend() {
    return *Shared<std::unique_ptr<Backend>>::get(GetParam(), [] {
      BackendOptions options;
      options.name = GetParam();
      options.validation = true;
      auto made = vorpipe::openBackend(options);
      if (!made) throw std::runtime_error(made.error().message);
      return std::move(made->backend);
    });
  }

  void TearDown() override {
    if (IsSkipped()) return;
    EXPECT_EQ(backend().validationMessages(), std::vector<std::string>());
  }
};

constexpr double short_edge = 1e-3;  // of the distance of its sites: floats may miss it

void compareWithBruteForce(const SiteSet& set, std::uint32_t site, CellStatus status,
                           std::span<const std::int32_t> neighbors) {
  const auto edges = edgesByBruteForce(set, site);
  const auto counting =
      std::ranges::count_if(edges, [](const auto& edge) { return edge.second > short_edge * short_edge; });
  if (status == CellStatus::empty) {
    EXPECT_LT(counting, 3) << "site " << site << " has a cell";
    EXPECT_FALSE(cellByBruteForce(set, site, neighbors).hasArea())
        << "site " << site << " is not proved empty";
    return;
  }
  EXPECT_FALSE(edges.empty()) << "site " << site << " is hidden";
  const std::set<std::int32_t> reported(neighbors.begin(), neighbors.end());
  EXPECT_EQ(reported.size(), neighbors.size()) << "site " << site;
  for (const auto& [neighbor, ratio] : edges) {
    EXPECT_TRUE(ratio < short_edge * short_edge || reported.contains(neighbor))
        << "site " << site << " lacks " << neighbor;
  }
  for (const auto neighbor : reported) {
    EXPECT_TRUE(edges.contains(neighbor)) << "site " << site << " has " << neighbor;
  }
}

TEST_P(WeightedBackend, FindsTheCellsOfBruteForce) {
  for (const auto& [name, set] : someSets()) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(backend().upload(set, {}).has_value());
    std::vector<std::uint32_t> wanted = range(0, set.size());
    for (const Capacity capacity : {Capacity::small, Capacity::large}) {
      CellNeighbors cells;
      ASSERT_TRUE(backend().cells(wanted, capacity, cells).has_value());
      std::vector<std::uint32_t> again;
      for (std::size_t k = 0; k < wanted.size(); k++) {
        const CellStatus status = cells.status[k];
        if (status != CellStatus::certified && status != CellStatus::empty) {
          again.push_back(wanted[k]);
          continue;
        }
        compareWithBruteForce(
            set, wanted[k], status,
            std::span(cells.neighbor).subspan(cells.offsets[k], cells.offsets[k + 1] - cells.offsets[k]));
      }
      wanted = std::move(again);
    }
    EXPECT_LE(wanted.size(), set.size() / 10) << "too many without an answer";
  }
}

// Without weights, with, and without again: on one device.
TEST_P(WeightedBackend, ForgetsWeights) {
  const SiteSet heavy = withHeavy(200, 10, 4);
  SiteSet plain = heavy;
  plain.weight.clear();
  plain.heavy.clear();
  plain.grid.heaviest.clear();
  std::vector<CellNeighbors> found;
  for (const auto& set : {std::cref<SiteSet>(plain), std::cref(heavy), std::cref<SiteSet>(plain)}) {
    ASSERT_TRUE(backend().upload(set, {}).has_value());
    ASSERT_TRUE(backend().cells(range(0, 200), Capacity::large, found.emplace_back()).has_value());
  }
  EXPECT_EQ(std::ranges::count(found[0].status, CellStatus::empty), 0);
  EXPECT_GT(std::ranges::count(found[1].status, CellStatus::empty), 20);
  EXPECT_EQ(found[0].status, found[2].status);
  EXPECT_EQ(found[0].neighbor, found[2].neighbor);
}

// A part of a set: what lies beyond the box that it knows may be heavier than all in it.
TEST_P(WeightedBackend, AreUnsecuredWhereUnknownSitesMayCut) {
  SiteSet set = noise(Pattern::random, 2000, 0.1);
  const double unknown = 0.02;  // 40 squares of the mean spacing
  set.coverage = {0.25, 0.25, 0.75, 0.75};
  const Grid& grid = set.grid;
  for (std::uint32_t row = 0; row < grid.rows; row++) {
    for (std::uint32_t column = 0; column < grid.columns; column++) {
      const double west = grid.xmin + column * grid.size;
      const double south = grid.ymin + row * grid.size;
      const bool known =
          west >= 0.25 && west + grid.size <= 0.75 && south >= 0.25 && south + grid.size <= 0.75;
      if (!known) set.grid.heaviest[row * grid.columns + column] = unknown;
    }
  }
  set.grid.heaviest.resize(std::size_t{grid.columns} * grid.rows);
  buildPyramid(set.grid);
  ASSERT_TRUE(backend().upload(set, {}).has_value());
  CellNeighbors cells;
  ASSERT_TRUE(backend().cells(range(0, 2000), Capacity::large, cells).has_value());
  for (std::size_t i = 0; i < 2000; i++) {
    const double to_unknown = 0.25 - std::max(std::abs(set.x[i] - 0.5), std::abs(set.y[i] - 0.5));
    // A site beyond the box, and so heavy, reaches farther than this.
    const CellStatus wrong = to_unknown < 0.13 ? CellStatus::certified : CellStatus::unsecured;
    const bool sure = to_unknown < 0.13 || to_unknown > 0.2;
    EXPECT_TRUE(!sure || cells.status[i] != wrong) << "site " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, WeightedBackend, testing::ValuesIn(backend_names),
                         [](const auto& backend) { return testName(backend.param); });

}  // namespace
}  // namespace vorpipe::test
