#include "geometry/vertex_position.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "cells/vertex_batch.h"
#include "unit/fixtures/proposed_cells.h"

namespace vorpipe::test {

using namespace core;

namespace {

bool same(const AnchoredPoint& a, const AnchoredPoint& b) {
  return a.base.x == b.base.x && a.base.y == b.base.y && a.rest.x == b.rest.x && a.rest.y == b.rest.y;
}

/// Calls check(place) for the corner of sites 0, 1, 2 as each order of them gives it.
template <class Check>
void forOrders(const SiteSet& set, const Check& check) {
  std::array<std::int32_t, 3> order{0, 1, 2};
  do {
    check(cornerPosition(set, order[0], order[1], order[2]));
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(CornerPlace, isTheSameForEveryOrderOfItsSites) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 200; ++round) {
    const double flat = round % 3 == 0 ? 1e-9 : 1;
    auto set = sitesAt({unit(random), unit(random), unit(random)},
                       {0.5 + flat * unit(random), 0.5 + flat * unit(random), 0.5 + flat * unit(random)});
    if (round % 5 == 0) set.x[1] = set.x[0];
    std::shuffle(set.id.begin(), set.id.end(), random);
    const auto first = cornerPosition(set, 0, 1, 2);
    forOrders(set, [&](const AnchoredPoint& place) { EXPECT_TRUE(same(first, place)); });
    EXPECT_TRUE(same(cornerPosition(set, 0, 1, wall_ymin), cornerPosition(set, 1, wall_ymin, 0)));
  }
}

TEST(CornerPlace, ofEqualSidesFollowsFromTheInputOrderAlone) {
  auto set = sitesAt({0, 1, 0.5}, {0, 0, 0.5 * std::sqrt(3.0)});
  auto turned = sitesAt({set.x[2], set.x[0], set.x[1]}, {set.y[2], set.y[0], set.y[1]});
  turned.id = {2, 0, 1};
  EXPECT_TRUE(same(cornerPosition(set, 0, 1, 2), cornerPosition(turned, 0, 1, 2)));
}

TEST(CornerBatch, placesCornersWhereCornerPlaceDoes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> x(400), y(400);
  // Corners of every second site, nearly on a line, are ones that double leaves unsure.
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = unit(random);
    y[i] = i % 2 == 0 ? 0.5 + 1e-9 * unit(random) : unit(random);
  }
  auto set = sitesAt(x, y);
  std::shuffle(set.id.begin(), set.id.end(), random);
  for (const bool weighted : {false, true}) {
    if (weighted) {
      set.weight.resize(x.size());
      for (auto& weight : set.weight) weight = 1e-3 * unit(random);
    }
    for (const auto edges : {std::size_t{3}, std::size_t{7}}) {
      std::vector<std::vector<std::int32_t>> rows(CornerBatch::most_corners / edges / 8 * 8);
      CornerBatch batch(set);
      for (std::size_t k = 0; k < std::min(rows.size(), CornerBatch::most_cells); ++k) {
        for (std::size_t e = 0; e < edges; ++e) rows[k].push_back(static_cast<std::int32_t>(2 * (k + e + 1)));
        ASSERT_EQ(batch.add(static_cast<std::uint32_t>(2 * k), rows[k]), CornerBatch::Added::yes);
      }
      batch.place();
      for (std::size_t k = 0; k < batch.size(); ++k) {
        for (std::size_t e = 0; e < edges; ++e) {
          const auto before = rows[k][(e + edges - 1) % edges];
          const auto alone = cornerPosition(set, static_cast<std::int32_t>(2 * k), before, rows[k][e]);
          EXPECT_TRUE(same(batch.placeOf(k, e), alone)) << edges << " edges, cell " << k << ", " << e;
        }
      }
    }
  }
}

/// The center lies at x = 0.5; its y follows from 0.25 + y^2 = (y - h)^2 with h = 2^-30, a power of two.
TEST(CornerPlace, ofSitesNearlyOnALineKeepsItsPrecision) {
  const double h = 0x1p-30;
  const auto set = sitesAt({0, 0.5, 1}, {0, h, 0});
  const auto place = cornerPosition(set, 0, 1, 2);
  EXPECT_DOUBLE_EQ(positionOf(place).x, 0.5);
  EXPECT_DOUBLE_EQ(positionOf(place).y, (h * h - 0.25) / (2 * h));
}

TEST(CornerPlace, keepsWhatPositionsWouldRoundOff) {
  // Three sites 2^-40 apart, far from the origin: their distances are exact, and so is the center.
  const double d = 0x1p-40;
  const auto set = sitesAt({1, 1 + d, 1}, {1, 1, 1 + d});
  const auto place = cornerPosition(set, 0, 1, 2);
  const auto way = relativeTo({1, 1}, place);
  EXPECT_EQ(way.x, d / 2);
  EXPECT_EQ(way.y, d / 2);
}

TEST(CornerPlace, ofWallsThatDoNotMeetIsNowhere) {
  const auto set = sitesAt({0.5}, {0.5});
  EXPECT_TRUE(std::isnan(cornerPosition(set, 0, wall_xmin, wall_xmax).base.x));
  EXPECT_EQ(cornerPosition(set, 0, wall_xmin, wall_ymax).base.y, 1);
}

TEST(EdgeSpan, isTheSameFromBothSides) {
  const auto set = jitteredSites(4, 0.4);
  const auto a = cornerPosition(set, 5, 6, 9), b = cornerPosition(set, 5, 6, 1);
  const auto here = edgeSpan(set, 5, 9, 6, 1, a, b), there = edgeSpan(set, 6, 1, 5, 9, b, a);
  EXPECT_EQ(here.excess, there.excess);
  EXPECT_EQ(here.isTie(), there.isTie());
  EXPECT_NE(here.isTurned(), edgeSpan(set, 5, 1, 6, 9, b, a).isTurned());
}

}  // namespace
}  // namespace vorpipe::test
