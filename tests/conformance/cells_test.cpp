/// What every backend promises of cells as data, by name: the same suite for each.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "conformance/cells_fixture.h"
#include "support/oracles/cell_oracle.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

TEST_P(Cells, tileTheDomain) {
  for (const std::uint64_t n : {1u, 2u, 3u, 10u, 100u, 3000u}) {
    SCOPED_TRACE(testing::Message() << n << " sites");
    EXPECT_EQ(expectTiled(generate(Pattern::random, n, 7)).report.ok, n);
  }
  for (const auto pattern :
       {Pattern::square, Pattern::hex, Pattern::jitter, Pattern::clusters, Pattern::circle}) {
    SCOPED_TRACE(testing::Message() << "pattern " << static_cast<int>(pattern));
    expectTiled(generate(pattern, 900, 3));
    expectTiled(generate(pattern, 900, 3), {0.31, -0.2, 0.93, 2});
  }
}

TEST_P(Cells, ofSitesOnALineAreStrips) {
  Sites sites;
  for (int i = 0; i < 50; ++i) {
    sites.x.push_back(0.125 + i / 64.0);
    sites.y.push_back(0.25);
  }
  const auto diagram = expectTiled(sites);
  for (std::size_t i = 1; i + 1 < 50; ++i) {
    EXPECT_EQ(neighborSet(diagram, i),
              (std::set<std::int64_t>{static_cast<std::int64_t>(i) - 1, static_cast<std::int64_t>(i) + 1,
                                      wall_ymin, wall_ymax}));
    EXPECT_EQ(diagram.area[i], 1 / 64.0);
  }
  EXPECT_TRUE(diagram.triangles.empty());
}

TEST_P(Cells, areMeasuredAsTheSquareThatTheyAre) {
  const auto diagram = expectTiled({{3}, {1}, {}}, {2, 0, 6, 2});
  EXPECT_EQ(neighborSet(diagram, 0), (std::set<std::int64_t>{wall_xmin, wall_xmax, wall_ymin, wall_ymax}));
  EXPECT_EQ(diagram.area[0], 8);
  EXPECT_EQ(diagram.perimeter[0], 12);
  EXPECT_NEAR(diagram.centroid[0].x, 4, 1e-14);
  EXPECT_NEAR(diagram.centroid[0].y, 1, 1e-14);
  EXPECT_NEAR(diagram.second_moments[0][0], 2 * 64 / 12.0, 1e-13);
  EXPECT_NEAR(diagram.second_moments[0][1], 0, 1e-13);
  EXPECT_NEAR(diagram.second_moments[0][2], 4 * 8 / 12.0, 1e-13);
}

TEST_P(Cells, ofSitesFarFromTheDomainAreNeighborsAcrossAllOfIt) {
  // The edge is 1e-8 of the way from one site to the other: no tie, for the domain is no longer.
  const auto diagram = expectTiled({{-5e7, 5e7 + 0.5}, {0.5, 0.5}, {}}, {0, 0, 1, 1});
  EXPECT_EQ(neighborSet(diagram, 0), (std::set<std::int64_t>{1, wall_xmin, wall_ymin, wall_ymax}));
  EXPECT_EQ(neighborSet(diagram, 1), (std::set<std::int64_t>{0, wall_xmax, wall_ymin, wall_ymax}));
  EXPECT_NEAR(diagram.area[0], 0.25, 1e-9);
}

TEST_P(Cells, ofASquareLatticeHaveFourNeighborsInside) {
  const auto diagram = expectTiled(generate(Pattern::square, 2500, 1));
  for (std::size_t i = 0; i < diagram.status.size(); ++i) {
    EXPECT_EQ(neighborSet(diagram, i).size(), 4u) << "site " << i;
    EXPECT_NEAR(diagram.area[i], 1 / 2500.0, 1e-15);
  }
  EXPECT_EQ(diagram.triangles.size(), 2u * 49 * 49);
}

TEST_P(Cells, ofAHexagonalLatticeHaveSixNeighborsInside) {
  const auto sites = generate(Pattern::hex, 2500, 1);
  const auto diagram = expectTiled(sites);
  int inside = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (std::max(std::abs(sites.x[i] - 0.5), std::abs(sites.y[i] - 0.5)) > 0.45) continue;
    EXPECT_EQ(neighborSet(diagram, i).size(), 6u) << "site " << i;
    ++inside;
  }
  EXPECT_GT(inside, 1500);
}

TEST_P(Cells, mayHaveHundredsOfNeighbors) {
  auto sites = generate(Pattern::circle, 300, 1);
  sites.x.push_back(0.5);
  sites.y.push_back(0.5);
  const auto neighbors = neighborSet(expectTiled(sites), 300);
  EXPECT_EQ(neighbors.size(), 300u);
  EXPECT_EQ(*neighbors.begin(), 0);
  EXPECT_EQ(*neighbors.rbegin(), 299);
}

TEST_P(Cells, ofDuplicatesBelongToTheLowestIndex) {
  auto sites = generate(Pattern::random, 400, 11);
  for (std::size_t i = 0; i < 80; ++i) {
    sites.x[5 * i + 4] = sites.x[i];
    sites.y[5 * i + 4] = sites.y[i];
  }
  const auto diagram = expectTiled(sites);
  EXPECT_GE(diagram.report.duplicate, 64u);
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    const auto owner = diagram.owner[i];
    EXPECT_EQ(diagram.status[i] == Status::duplicate, owner != i);
    EXPECT_LE(owner, i);
    EXPECT_EQ(diagram.status[owner], Status::ok);
    EXPECT_EQ(sites.x[owner], sites.x[i]);
    EXPECT_EQ(sites.y[owner], sites.y[i]);
  }
}

TEST_P(Cells, ofSitesOutsideTheDomainMayBeEmpty) {
  const Sites sites{{0, 1, 0.5, 0.5, -0.5, 1.5, 3, 0.5}, {0, 1, 0, 0.5, 0.5, 0.5, 3, -40}, {}};
  const auto diagram = expectTiled(sites);
  using enum Status;
  EXPECT_EQ(diagram.status, (std::vector<Status>{ok, ok, ok, ok, empty, empty, empty, empty}));
  expectTiled({{5, 5.5, 7}, {-2, 3, 900}, {}});
  expectTiled({{1.25, -0.25, 0.5}, {0.5, 0.5, 1.5}, {}});
}

TEST_P(Cells, comeInInputOrder) {
  const auto sites = generate(Pattern::random, 500, 8);
  auto backwards = sites;
  std::reverse(backwards.x.begin(), backwards.x.end());
  std::reverse(backwards.y.begin(), backwards.y.end());
  const auto diagram = expectTiled(sites);
  const auto reversed = expectTiled(backwards);
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_NEAR(diagram.area[i], reversed.area[499 - i], 1e-12 / 500);
    std::set<std::int64_t> mirrored;
    for (const auto neighbor : neighborSet(reversed, 499 - i))
      mirrored.insert(neighbor < 0 ? neighbor : 499 - neighbor);
    EXPECT_EQ(neighborSet(diagram, i), mirrored);
  }
}

TEST_P(Cells, keepTheirShapeInAnyRangeOfCoordinates) {
  const auto sites = generate(Pattern::random, 500, 5);
  const auto plain = expectTiled(sites);
  const std::array<std::array<double, 3>, 5> ranges{
      {{1e-9, 0, 1e-10}, {1e12, 0, 1e-10}, {3e-7, 0, 1e-10}, {1e3, 5e6, 1e-6}, {1e-3, 77, 1e-6}}};
  for (const auto& [scale, offset, precision] : ranges) {
    SCOPED_TRACE(testing::Message() << scale << " at " << offset);
    Sites moved;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      moved.x.push_back(offset + scale * sites.x[i]);
      moved.y.push_back(-offset + scale * sites.y[i]);
    }
    const auto diagram = expectTiled(moved, {offset, -offset, offset + scale, -offset + scale});
    for (std::size_t i = 0; i < sites.size(); ++i) {
      EXPECT_NEAR(diagram.area[i] / scale / scale, plain.area[i], precision / 500) << "site " << i;
      EXPECT_EQ(neighborSet(diagram, i), neighborSet(plain, i)) << "site " << i;
    }
  }
}

TEST_P(Cells, ofSitesATrillionthOfTheDomainApartAreTwo) {
  auto sites = generate(Pattern::random, 100, 9);
  for (std::size_t i = 0; i < 20; ++i) {
    sites.x.push_back(sites.x[i] + 1e-12);
    sites.y.push_back(sites.y[i] - 2e-12);
  }
  const auto diagram = expectTiled(sites);
  EXPECT_EQ(diagram.report.ok, 120u);
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_TRUE(neighborSet(diagram, i).contains(static_cast<std::int64_t>(100 + i)));
}

/// West, east, north and south of (0.5, 0.5); west and east meet along an edge of about `part` of the
/// distance between them.
Sites cross(double part) {
  const double near = 0.25;
  const double far = near * (1 + part);
  return {{0.5 - near, 0.5 + near, 0.5, 0.5}, {0.5, 0.5, 0.5 + far, 0.5 - far}, {}};
}

TEST_P(Cells, doNotReportAnEdgeShorterThanAMillionth) {
  const auto longer = expectTiled(cross(2e-6));
  EXPECT_TRUE(neighborSet(longer, 0).contains(1));
  EXPECT_EQ(longer.triangles.size(), 2u);
  for (const double part : {5e-7, 1e-12, 0.0, -1e-12, -5e-7}) {
    SCOPED_TRACE(part);
    const auto shorter = expectTiled(cross(part));
    EXPECT_FALSE(neighborSet(shorter, 0).contains(1));
    EXPECT_FALSE(neighborSet(shorter, 2).contains(3));
    EXPECT_EQ(shorter.triangles.size(), 2u);
  }
}

/// The vertex of the first three sites lies just inside of the wall xmax, the fourth cell elsewhere.
TEST_P(Cells, tileTheDomainWhereATieEndsAtAWall) {
  for (const double inside : {1e-8, 1e-7, 2e-7, -1e-8}) {
    SCOPED_TRACE(inside);
    const double x = 1 - inside;
    expectTiled({{x - 0.4, x - 0.3, x - 0.3}, {0.5, 0.5 + std::sqrt(0.07), 0.5 - std::sqrt(0.07)}, {}});
    expectTiled({{x - 0.3, x - 0.3, x - 0.4}, {0.5 + std::sqrt(0.07), 0.5 - std::sqrt(0.07), 0.5}, {}});
  }
}

TEST_P(Cells, areDualToTheDelaunayTriangles) {
  const auto sites = generate(Pattern::random, 300, 17);
  const auto diagram = expectTiled(sites, {-3000, -3000, 3000, 3000});
  expectDelaunay(diagram, sites);
  EXPECT_EQ(diagram.triangles.size(), 2 * 300 - 2 - hullSize(sites));
  expectDelaunay(expectTiled(sites), sites);
}

TEST_P(Cells, ofBadInputAreRefused) {
  auto& session = sharedSession(GetParam());
  const auto sites = generate(Pattern::random, 50, 1);
  const auto refusal = [&](const Sites& bad, const CellsOptions& wanted) {
    const auto result = session.cells(bad, wanted);
    EXPECT_TRUE(!result && !result.error().message.empty());
    return result ? ErrorCode::device : result.error().code;
  };
  EXPECT_EQ(refusal({}, within(unit)), ErrorCode::input);
  EXPECT_EQ(refusal({{0.5, std::nan("")}, {0.5, 0.5}, {}}, within(unit)), ErrorCode::input);
  EXPECT_EQ(refusal(sites, within({0, 1, 1, 0})), ErrorCode::input);
  EXPECT_EQ(refusal(sites, within({0, 0, INFINITY, 1})), ErrorCode::input);
  EXPECT_EQ(refusal(sites, within(unit, {Search::flann, 2})), ErrorCode::input);
  auto stopped = within(unit);
  stopped.progress = [](auto, double) { return false; };
  EXPECT_EQ(refusal(sites, stopped), ErrorCode::cancelled);
}

INSTANTIATE_TEST_SUITE_P(Backends, Cells, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test
