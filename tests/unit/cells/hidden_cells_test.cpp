/// Proofs that cells are empty, and corners of cells with weights, against rational numbers.
#include "cells/hidden_cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "geometry/vertex_position.h"
#include "support/sites/random_sites.h"
#include "unit/fixtures/brute_force.h"
#include "unit/fixtures/proposed_cells.h"

namespace vorpipe::test {

using namespace core;

namespace {

std::vector<std::int32_t> someOf(const SiteSet& set, std::uint32_t cell, Random& random, std::uint64_t most) {
  std::vector<std::int32_t> lines;
  for (auto left = 1 + random.below(most); left > 0; --left) {
    const auto line = static_cast<std::int32_t>(random.below(set.size() + 4)) - 4;
    if (line != static_cast<std::int32_t>(cell)) lines.push_back(line);
  }
  return lines;
}

/// Returns how many of the cells are left nothing of.
int expectAsByBruteForce(const SiteSet& set, Random& random, std::uint64_t most_lines) {
  int nothing = 0;
  for (std::uint32_t cell = 0; cell < set.size(); ++cell) {
    const auto lines = someOf(set, cell, random, most_lines);
    const bool expected = !cellByBruteForce(set, cell, lines).hasArea();
    EXPECT_EQ(leaveNothing(set, cell, lines), expected) << "site " << cell;
    nothing += expected ? 1 : 0;
  }
  return nothing;
}

TEST(LeaveNothing, isExactOnLattices) {
  Random random(2);
  int nothing = 0, all = 0;
  for (int round = 0; round < 300; ++round) {
    SiteSet set = sitesAt({}, {});
    set.domain = {0, 0, 8, 4};
    for (std::uint32_t place = 0; place < 117; ++place) {
      if (random.below(4) != 0) continue;
      set.x.push_back(static_cast<double>(place % 13) - 2);
      set.y.push_back(static_cast<double>(place / 13) - 2);
      set.weight.push_back(static_cast<double>(random.below(8)));
      set.id.push_back(static_cast<std::uint32_t>(set.id.size()));
    }
    all += static_cast<int>(set.size());
    nothing += expectAsByBruteForce(set, random, 3 + random.below(12));
  }
  EXPECT_GT(nothing, all / 10);
  EXPECT_LT(nothing, all / 2);
}

/// All bisectors pass nearly through one point.
TEST(LeaveNothing, isExactNearTies) {
  Random random(4);
  int nothing = 0;
  for (const double noise : {0.0, 1e-17, 1e-16, 1e-12}) {
    SiteSet set = sitesAt({}, {});
    for (std::uint32_t i = 0; i < 200; ++i) {
      const double x = random.uniform(), y = random.uniform();
      const double power = (x - 0.3) * (x - 0.3) + (y - 0.7) * (y - 0.7);
      set.x.push_back(x);
      set.y.push_back(y);
      set.weight.push_back(power + noise * random.normal());
      set.id.push_back(i);
    }
    nothing += expectAsByBruteForce(set, random, 12);
  }
  EXPECT_GT(nothing, 100);
  EXPECT_LT(nothing, 700);
}

TEST(LeaveNothing, ofAnyRange) {
  Random random(8);
  for (const double size : {1e-8, 1e-3, 1e30, 1e90}) {
    SiteSet set = sitesAt({0.1, 0.9, 0.5}, {0.2, 0.3, 0.8});
    set.weight = {0, 0.1 * size, 0.3};
    for (std::uint32_t i = 3; i < 60; ++i) {
      set.x.push_back(0.5 + size * random.normal());
      set.y.push_back(0.5 + size * random.normal());
      set.weight.push_back(size * size * random.normal());
      set.id.push_back(i);
    }
    expectAsByBruteForce(set, random, 20);
  }
}

TEST(ProveEmpty, takesTheProofAndOpensWhatHasNone) {
  SiteSet set = sitesAt({0.5, 0.4, 0.6, 0.5}, {0.5, 0.4, 0.4, 0.7});
  set.weight = {0, 1, 1, 1};
  CellNeighbors found;
  found.status = {CellStatus::empty, CellStatus::certified, CellStatus::empty, CellStatus::empty};
  found.offsets = {0, 3, 6, 8, 8};
  found.neighbor = {1, 2, 3, wall_xmin, 2, 3, 1, 3};
  const std::array<std::uint32_t, 4> which{0, 1, 2, 3};
  NeighborRows cells(4, 2);
  cells.add(which, std::move(found));
  proveEmpty(set, which, 2, cells);
  EXPECT_EQ(cells.status(0), CellStatus::empty);
  EXPECT_EQ(cells.status(1), CellStatus::certified);
  EXPECT_EQ(cells.status(2), CellStatus::open);
  EXPECT_EQ(cells.status(3), CellStatus::open);
  for (const auto cell : {0u, 2u, 3u}) EXPECT_TRUE(cells.edges(cell).empty());
  EXPECT_THAT(cells.edges(1), testing::ElementsAre(wall_xmin, 2, 3));
}

/// The point whose powers to three sites are equal, in units of double.
std::array<double, 2> radicalCenter(const SiteSet& set, std::size_t i, std::size_t j, std::size_t k) {
  const auto line = [&](std::size_t other) {
    const Rational dx = Rational(set.x[other]) - set.x[i], dy = Rational(set.y[other]) - set.y[i];
    return std::array<Rational, 3>{dx, dy, (dx * dx + dy * dy + set.weight[i] - set.weight[other]) / 2};
  };
  const auto b = line(j), c = line(k);
  const Rational area = b[0] * c[1] - b[1] * c[0];
  return {static_cast<double>(Rational((b[2] * c[1] - c[2] * b[1]) / area + set.x[i])),
          static_cast<double>(Rational((b[0] * c[2] - c[0] * b[2]) / area + set.y[i]))};
}

TEST(WeightedCorner, isTheSameForEveryOrderAndPrecise) {
  Random random(6);
  for (int round = 0; round < 3000; ++round) {
    const double flat = round % 3 == 0 ? 1e-9 : 1;
    const auto far = [&] { return round % 4 == 0 ? 30 * random.normal() : random.uniform(); };
    auto set = sitesAt({far(), far(), far()}, {0.5 + flat * far(), 0.5 + flat * far(), 0.5 + flat * far()});
    if (round % 5 == 0) set = sitesAt({0, 1, 0.5}, {0, 0, 0.75});  // two equal sides
    // The center is in the domain, near some point there.
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = set.x[i] - 0.3, y = set.y[i] - 0.6;
      set.weight.push_back(x * x + y * y + (round % 2 == 0 ? 0.01 * flat * random.uniform() : 0));
    }
    const auto first = cornerPosition(set, 0, 1, 2);
    const auto exact = radicalCenter(set, 0, 1, 2);
    const double reach = std::abs(set.x[0] - set.x[1]) + std::abs(set.x[0] - set.x[2]) + 1;
    EXPECT_NEAR(positionOf(first).x, exact[0], 1e-13 * (reach + std::abs(exact[0]))) << round;
    EXPECT_NEAR(positionOf(first).y, exact[1], 1e-13 * (reach + std::abs(exact[1]))) << round;
    std::array<std::int32_t, 3> order{0, 1, 2};
    do {
      const auto place = cornerPosition(set, order[0], order[1], order[2]);
      ASSERT_EQ(place.base.x, first.base.x);
      ASSERT_EQ(place.base.y, first.base.y);
      ASSERT_EQ(place.rest.x, first.rest.x);
      ASSERT_EQ(place.rest.y, first.rest.y);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(WeightedCorner, atAWallIsWhereThePowersAreEqual) {
  Random random(7);
  for (int round = 0; round < 1000; ++round) {
    auto set = sitesAt({random.uniform(), random.uniform()}, {random.uniform(), random.uniform()});
    if (round % 3 == 0) set.y[1] = set.y[0] + 1e-9 * random.normal();
    // The bisector meets the wall near (1, 0.25).
    for (std::size_t i = 0; i < 2; ++i) {
      const double x = set.x[i] - 1, y = set.y[i] - 0.25;
      set.weight.push_back(x * x + y * y);
    }
    const auto place = cornerPosition(set, 0, 1, wall_xmax);
    EXPECT_EQ(positionOf(place).x, 1);
    const Rational dx = Rational(set.x[1]) - set.x[0], dy = Rational(set.y[1]) - set.y[0];
    const Rational half = (dx * dx + dy * dy + set.weight[0] - set.weight[1]) / 2;
    const Rational y = (half - (1 - Rational(set.x[0])) * dx) / dy + set.y[0];
    EXPECT_NEAR(positionOf(place).y, static_cast<double>(y), 1e-13 * (2 + std::abs(static_cast<double>(y))));
    const auto other = cornerPosition(set, 1, wall_xmax, 0);
    EXPECT_EQ(place.rest.y, other.rest.y);
  }
}

}  // namespace
}  // namespace vorpipe::test
