/// Whole runs over sites with weights: against brute force in rational numbers, and the promises of the
/// interface.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "sites/site_set.h"
#include "support/oracles/same_bytes.h"
#include "support/sites/random_sites.h"
#include "unit/fixtures/brute_force.h"
#include "unit/fixtures/checked_runs.h"

namespace vorpipe::test {

using namespace core;

namespace {

constexpr double shortest = 1e-12;  ///< squared

Sites noise(std::size_t count, double most, std::uint64_t seed = 1) {
  Random random(seed);
  Sites sites;
  for (std::size_t i = 0; i < count; ++i) {
    add(sites, {random.uniform(), random.uniform()});
    sites.weight.push_back(most / static_cast<double>(count) * random.uniform());
  }
  return sites;
}

/// Checks a run as vorpipe's check() does, and returns the cells.
Diagram checked(const Sites& sites, const CellsOptions& options = unit_cells) {
  auto cells = cellsOf(sites, options);
  const auto broken = check(sites, options, cells, 2);
  EXPECT_TRUE(broken && broken->empty()) << (broken ? broken->front() : broken.error().message);
  return cells;
}

Rational areaOf(const RationalCell& cell) {
  Rational twice = 0;
  for (std::size_t k = 0; k < cell.corner.size(); ++k) {
    const auto& p = cell.corner[k];
    const auto& q = cell.corner[(k + 1) % cell.corner.size()];
    twice += p.x * q.y - p.y * q.x;
  }
  return twice / 2;
}

/// Compares every cell with brute force: its status, neighbors and area.
void compare(const Sites& sites, const Diagram& cells) {
  const auto prepared = prepare(sites, unit_cells.domain, 1);
  ASSERT_TRUE(prepared);
  const auto& set = prepared->set;
  for (std::uint32_t i = 0; i < set.size(); ++i) {
    SCOPED_TRACE("site " + std::to_string(set.id[i]));
    const auto id = set.id[i];
    const auto others = othersByPower(set, i);
    const RationalCell cell = cellByBruteForce(set, i, others);
    const double area = std::ldexp(static_cast<double>(areaOf(cell)), -2 * prepared->exponent);
    EXPECT_EQ(cells.status[id], area > 0 ? Status::ok : Status::empty);
    EXPECT_NEAR(cells.area[id], area, 1e-12);
    std::set<std::int64_t> reported(
        cells.neighbors.begin() + static_cast<std::ptrdiff_t>(cells.cell_offsets[id]),
        cells.neighbors.begin() + static_cast<std::ptrdiff_t>(cells.cell_offsets[id + 1]));
    for (const auto& [neighbor, ratio] : edgesByBruteForce(set, cell, others)) {
      if (neighbor < 0) continue;
      const bool has = reported.contains(set.id[static_cast<std::size_t>(neighbor)]);
      if (ratio > 1.01 * shortest) {
        EXPECT_TRUE(has) << "lacks " << set.id[static_cast<std::size_t>(neighbor)];
      } else if (ratio < 0.99 * shortest) {
        EXPECT_FALSE(has) << "has " << set.id[static_cast<std::size_t>(neighbor)];
      }
    }
  }
}

void expectRight(const Sites& sites) { compare(sites, checked(sites)); }

TEST(WeightedCells, ofRandomWeights) {
  for (const double most : {0.1, 1.0, 10.0, 100.0, 1e4}) {
    for (const std::size_t count : {1u, 2u, 3u, 10u, 150u}) {
      SCOPED_TRACE(most);
      SCOPED_TRACE(count);
      expectRight(noise(count, most));
    }
  }
  checked(noise(20000, 100));
}

TEST(WeightedCells, allHiddenButOne) {
  for (const double weight : {2.1, 1e3, 1e15, 1e150}) {
    auto sites = noise(200, 1);
    sites.weight[17] = weight;
    const auto cells = checked(sites);
    EXPECT_EQ(cells.report.ok, 1u);
    EXPECT_EQ(cells.report.empty, 199u);
    EXPECT_EQ(cells.area[17], 1);
    sites.weight[17] = -weight;
    EXPECT_EQ(checked(sites).status[17], Status::empty);
  }
}

TEST(WeightedCells, ofEqualWeightsAreThoseOfNone) {
  auto sites = mixedSites();
  const auto cells = cellsOf(sites, unit_cells);
  for (const double weight : {0.0, 1e9 / 3, -1e-300}) {
    sites.weight.assign(sites.size(), weight);
    expectSameBytes(cellsOf(sites, unit_cells), cells);
  }
}

TEST(WeightedCells, areTheSameWithAConstantAdded) {
  for (const double most : {1.0, 100.0}) {
    auto sites = noise(3000, most);
    for (auto& weight : sites.weight) weight = std::round(weight * 0x1p30) * 0x1p-30;
    const auto cells = checked(sites);
    for (const double more : {1e6, -1e6, 0.25}) {
      auto moved = sites;
      for (auto& weight : moved.weight) weight += more;
      expectSameBytes(checked(moved), cells);
    }
  }
}

/// Of a checkerboard of weights, where all corners are ties of four powers, or hide the light sites exactly.
TEST(WeightedCells, ofLatticesWithTies) {
  constexpr int side = 8;
  constexpr double hides = 1.0 / side / side;
  for (const double heavy : {hides / 2, hides * (1 - 0x1p-20), hides * (1 - 0x1p-50), hides,
                             hides * (1 + 0x1p-50), hides * 2, hides * 8}) {
    SCOPED_TRACE(heavy / hides);
    Sites sites;
    for (int i = 0; i < side * side; ++i) {
      add(sites, {(i % side + 0.5) / side, (i / side + 0.5) / side});
      sites.weight.push_back((i + i / side) % 2 == 0 ? heavy : 0);
    }
    expectRight(sites);
  }
}

TEST(WeightedCells, ofLatticesWithAnyWeights) {
  Random random(9);
  for (const std::uint64_t levels : {2u, 3u, 9u}) {
    Sites sites;
    for (int i = 0; i < 144; ++i) {
      add(sites, {(i % 12 + 0.5) / 12, static_cast<double>(i / 12) / 8});
      sites.weight.push_back(static_cast<double>(random.below(levels)) / 128);
    }
    expectRight(sites);
  }
}

/// All bisectors pass through one point, or nearly so.
TEST(WeightedCells, thatMeetInOneVertex) {
  for (const double noise : {0.0, 1e-17, 1e-15, 1e-12, 1e-8}) {
    SCOPED_TRACE(noise);
    Random random(3);
    Sites sites;
    for (int i = 0; i < 60; ++i) {
      add(sites,
          {static_cast<double>(random.below(1024)) / 1024, static_cast<double>(random.below(1024)) / 1024});
      const double x = sites.x.back() - 0.5, y = sites.y.back() - 0.25;
      sites.weight.push_back(x * x + y * y + noise * random.normal());
    }
    expectRight(sites);
  }
}

TEST(WeightedCells, ofSitesOutsideTheDomain) {
  Random random(4);
  for (const double size : {0.5, 2.0, 30.0}) {
    Sites sites;
    for (int i = 0; i < 120; ++i) {
      add(sites, {0.5 + size * random.normal(), 0.5 + size * random.normal()});
      const double x = sites.x.back() - 0.5, y = sites.y.back() - 0.5;
      sites.weight.push_back(x * x + y * y + 0.3 * random.uniform());
    }
    expectRight(sites);
  }
}

TEST(WeightedCells, ofDuplicates) {
  auto sites = noise(150, 5);
  Random random(6);
  for (int k = 0; k < 100; ++k) {
    const auto twin = random.below(150);
    add(sites, {sites.x[twin], sites.y[twin]});
    sites.weight.push_back(random.below(2) == 0 ? sites.weight[twin] : 5.0 / 150 * random.uniform());
  }
  expectRight(sites);
}

TEST(WeightedCells, ofCrowdsAndCurves) {
  Random random(7);
  Sites sites;
  for (int i = 0; i < 200; ++i) {
    const bool crowd = i % 2 == 0;
    const double t = random.uniform();
    add(sites,
        crowd ? Point{0.3 + 1e-5 * random.uniform(), 0.6 + 1e-5 * t} : Point{t, 0.5 + 0.2 * std::sin(7 * t)});
    sites.weight.push_back((crowd ? 1e-12 : 1e-3) * random.uniform());
  }
  expectRight(sites);
}

TEST(WeightedCells, ofOtherWeightsBreakPromises) {
  using ::testing::Contains;
  auto sites = mixedSites();
  for (std::size_t i = 0; i < sites.size(); ++i)
    sites.weight.push_back(1e-3 * static_cast<double>(i * 37 % 11));
  const auto right = checked(sites);
  ASSERT_GT(right.report.empty, 20u);
  auto cells = right;
  const auto broken = [&] { return promisesOf(check(sites, unit_cells, cells, 2)); };
  const auto hidden = static_cast<std::size_t>(
      std::find(right.status.begin(), right.status.end(), Status::empty) - right.status.begin());
  cells.status[hidden] = Status::ok;
  EXPECT_THAT(broken(), Contains("statuses"));
  cells = right;
  cells.triangles[0][0] = static_cast<std::uint32_t>(hidden);
  EXPECT_THAT(broken(), Contains("triangles"));
  cells = right;
  cells.owner[7] = cells.owner[200] = 7;
  EXPECT_THAT(broken(), Contains("owners"));
  cells = right;
  sites.weight[50] += 1e-3;
  EXPECT_THAT(broken(), Contains("nearest sites"));
  sites.weight.clear();
  EXPECT_THAT(broken(), Contains("statuses"));
}

TEST(WeightedCells, areNotSearchedByFlann) {
  auto options = unit_cells;
  options.search.method = Search::flann;
  auto sites = noise(50, 1);
  const auto cells = cpuSession().cells(sites, options);
  ASSERT_FALSE(cells);
  EXPECT_EQ(cells.error().code, ErrorCode::input);
  sites.weight.assign(50, 7);
  checked(sites, options);
}

TEST(WeightedPicture, showsTheCells) {
  for (const double most : {1.0, 100.0}) {
    const auto sites = noise(2000, most);
    RenderOptions options{};
    options.domain = {0, 0, 1, 1};
    options.width = 300;
    options.height = 200;
    const auto picture = cpuSession().render(sites, options);
    ASSERT_TRUE(picture) << picture.error().message;
    const auto broken = check(sites, options, *picture, 2);
    EXPECT_TRUE(broken && broken->empty()) << (broken ? broken->front() : broken.error().message);
    EXPECT_EQ(picture->status, cellsOf(sites, unit_cells).status);
  }
}

}  // namespace
}  // namespace vorpipe::test
