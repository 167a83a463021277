/// What every backend promises of the cells of periodic domains, by name: the same suite for each.
#include <array>
#include <cmath>
#include <set>

#include "conformance/periodic_fixture.h"
#include "support/sites/data_sets.h"

namespace vorpipe::test {
namespace {

/// The cell of site i has `count` neighbors, and no image of a site twice.
void expectNeighbors(const Diagram& d, std::size_t i, std::size_t count) {
  EXPECT_EQ(imagesBeside(d, i).size(), count) << "site " << i;
  EXPECT_EQ(d.cell_offsets[i + 1] - d.cell_offsets[i], count) << "site " << i;
}

TEST_P(PeriodicCells, ofASquareLatticeAreEqualSquares) {
  for (const std::uint64_t side : {1u, 2u, 3u, 10u, 64u}) {
    SCOPED_TRACE(side);
    const std::uint64_t n = side * side;
    const auto d = expectRight(generate(Pattern::square, n, 1), repeated(Periodic::xy));
    for (std::size_t i = 0; i < n; ++i) {
      expectNeighbors(d, i, 4);
      EXPECT_NEAR(d.area[i] * static_cast<double>(n), 1, 1e-13) << "site " << i;
    }
  }
}

TEST_P(PeriodicCells, ofAHexagonalLatticeAreEqualHexagons) {
  for (const auto& [columns, rows] : {std::pair{1, 2}, {2, 2}, {5, 6}, {40, 46}}) {
    SCOPED_TRACE(testing::Message() << columns << " x " << rows);
    const double apart = 1.0 / columns, high = std::sqrt(3) / 2 * apart;
    Sites sites;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        sites.x.push_back((column + 0.25 + 0.5 * (row % 2)) * apart);
        sites.y.push_back((row + 0.5) * high);
      }
    }
    const auto d = expectRight(sites, repeated(Periodic::xy, {0, 0, 1, rows * high}));
    for (std::size_t i = 0; i < sites.size(); ++i) {
      expectNeighbors(d, i, 6);
      EXPECT_NEAR(d.area[i] / (apart * high), 1, 1e-12) << "site " << i;
    }
  }
}

TEST_P(PeriodicCells, areTheMiddleNinthOfNineTiles) {
  for (const auto pattern : {Pattern::random, Pattern::clusters, Pattern::jitter}) {
    for (const std::uint64_t n : {7u, 300u, 4000u}) {
      SCOPED_TRACE(testing::Message() << "pattern " << static_cast<int>(pattern) << ", " << n << " sites");
      const auto sites = generate(pattern, n, 5);
      for (const auto periodic : {Periodic::x, Periodic::y, Periodic::xy}) {
        SCOPED_TRACE(testing::Message() << "periodic " << static_cast<int>(periodic));
        const auto wanted = repeated(periodic);
        const auto tiled = tile(sites, wanted);
        expectMiddle(expectRight(sites, wanted),
                     cells(tiled.sites, within(tiled.domain, {}, Detail::measures)), tiled, 1e-11);
      }
    }
  }
}

TEST_P(PeriodicCells, ofOneSiteMeetItself) {
  const Sites one{{0.3}, {0.9}, {}};
  const auto d = expectRight(one, repeated(Periodic::xy, {0, 0, 2, 1}));
  EXPECT_EQ(imagesBeside(d, 0), (std::set<ImageOf>{{0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}));
  EXPECT_NEAR(d.area[0], 2, 1e-15);
  EXPECT_NEAR(d.centroid[0].x, 0.3, 1e-15);
  EXPECT_NEAR(d.centroid[0].y, 0.9, 1e-15);
  const auto x = expectRight(one, repeated(Periodic::x, {0, 0, 2, 1}));
  EXPECT_EQ(imagesBeside(x, 0),
            (std::set<ImageOf>{{0, -1, 0}, {0, 1, 0}, {wall_ymin, 0, 0}, {wall_ymax, 0, 0}}));
}

TEST_P(PeriodicCells, ofFewSitesFillTheDomain) {
  for (const auto periodic : {Periodic::x, Periodic::y, Periodic::xy}) {
    for (const std::uint64_t n : {1u, 2u, 3u, 5u, 20u}) {
      for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
        SCOPED_TRACE(testing::Message() << n << " sites, seed " << seed);
        const auto d = expectRight(generate(Pattern::random, n, seed), repeated(periodic));
        EXPECT_EQ(d.report.ok, n);
      }
    }
  }
  // Two sites that share a whole row of edges, and three on a line.
  expectRight({{0, 0.5}, {0, 0.5}, {}}, repeated(Periodic::xy));
  expectRight({{0.1, 0.2, 0.7}, {0.5, 0.5, 0.5}, {}}, repeated(Periodic::xy));
}

TEST_P(PeriodicCells, fillLongThinDomains) {
  for (const std::uint64_t n : {1u, 2u, 7u, 200u, 3000u}) {
    SCOPED_TRACE(n);
    auto sites = generate(Pattern::random, n, 3);
    for (double& y : sites.y) y *= 0.01;
    for (const auto periodic : {Periodic::x, Periodic::y, Periodic::xy}) {
      EXPECT_EQ(expectRight(sites, repeated(periodic, {0, 0, 1, 0.01})).report.ok, n);
    }
  }
}

TEST_P(PeriodicCells, ofBothEndsOfAPeriodAreOne) {
  const Sites sites{{0, 1, 0.5, 1, 0.5}, {0.25, 0.25, 0, 0.75, 1}, {}};
  const auto d = expectRight(sites, repeated(Periodic::xy));
  EXPECT_EQ(d.owner, (std::vector<std::uint32_t>{0, 0, 2, 3, 2}));
  EXPECT_EQ(d.report.duplicate, 2u);
  EXPECT_NEAR(d.centroid[3].x, 1, 0.3) << "a cell is around its site";
  EXPECT_NEAR(d.centroid[0].x, 0, 0.3);
  const auto x = expectRight(sites, repeated(Periodic::x));
  EXPECT_EQ(x.owner, (std::vector<std::uint32_t>{0, 0, 2, 3, 4}));
}

TEST_P(PeriodicCells, ofSitesOutsideAreThoseOfTheirImages) {
  const auto sites = generate(Pattern::random, 200, 8);
  auto moved = sites;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved.x[i] += static_cast<double>(i % 7) - 3;
    moved.y[i] += i % 5 == 0 ? 1e6 : 0;
  }
  const auto plain = expectRight(sites, repeated(Periodic::xy));
  const auto d = expectRight(moved, repeated(Periodic::xy));
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_EQ(imagesBeside(d, i), imagesBeside(plain, i)) << "site " << i;
    EXPECT_NEAR(d.area[i], plain.area[i], 1e-9);
    EXPECT_NEAR(d.centroid[i].x, plain.centroid[i].x, 1e-8);
  }
  // Along an axis that does not repeat they stay where they are.
  const auto x = expectRight({{0.5, 4.25, 0.7}, {0.5, 1.25, -7}, {}}, repeated(Periodic::x));
  EXPECT_EQ(x.status, (std::vector<Status>{Status::ok, Status::ok, Status::empty}));
}

TEST_P(PeriodicCells, areRightInAnyRangeOfCoordinates) {
  const auto sites = generate(Pattern::random, 300, 5);
  const auto plain = expectRight(sites, repeated(Periodic::xy));
  const std::array<std::array<double, 3>, 6> ranges{{{1e-9, 0, 1e-10},
                                                     {1e12, 0, 1e-10},
                                                     {1e-140, 0, 1e-10},
                                                     {1e3, 5e6, 1e-6},
                                                     {1e-3, 77, 1e-6},
                                                     {0.7, -0.1, 1e-9}}};
  for (const auto& [scale, offset, precision] : ranges) {
    SCOPED_TRACE(testing::Message() << scale << " at " << offset);
    Sites moved;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      moved.x.push_back(offset + scale * sites.x[i]);
      moved.y.push_back(-offset + scale * sites.y[i]);
    }
    const auto d =
        expectRight(moved, repeated(Periodic::xy, {offset, -offset, offset + scale, -offset + scale}));
    for (std::size_t i = 0; i < sites.size(); ++i) {
      EXPECT_NEAR(d.area[i] / scale / scale, plain.area[i], precision / 300) << "site " << i;
      EXPECT_EQ(imagesBeside(d, i), imagesBeside(plain, i)) << "site " << i;
    }
  }
}

/// Four sites around a corner of the domain, two of which meet along an edge of about `part` of their
/// distance: each of the four sees the edge in another copy.
Sites crossAtCorner(double part, double turn) {
  Sites sites;
  const auto add = [&](double angle, double distance) {
    const double x = distance * std::cos(angle + turn), y = distance * std::sin(angle + turn);
    sites.x.push_back(x - std::floor(x));
    sites.y.push_back(y - std::floor(y));
  };
  const double quarter = std::acos(0.0);
  for (const int k : {0, 2}) add(k * quarter, 0.25);
  for (const int k : {1, 3}) add(k * quarter, 0.25 * (1 + part));
  return sites;
}

TEST_P(PeriodicCells, agreeAcrossTheBorderAboutTies) {
  for (const double turn : {0.0, 0.1, 0.5, 1.0}) {
    for (const double part : {0.0, 1e-12, 9.9e-7, 1e-6 - 1e-16, 1e-6, 1e-6 + 1e-16, 1e-6 + 1e-12, 1.1e-6}) {
      SCOPED_TRACE(testing::Message() << part << " turned by " << turn);
      expectRight(crossAtCorner(part, turn), repeated(Periodic::xy));
      expectRight(crossAtCorner(-part, turn), repeated(Periodic::xy));
    }
  }
}

TEST_P(PeriodicCells, ofEveryDataSetFillTheDomain) {
  for (const auto& kind : dataSetKinds()) {
    const auto set = makeDataSet(kind.name, 200, 12);
    for (const auto periodic : {Periodic::x, Periodic::xy}) {
      SCOPED_TRACE(testing::Message() << set.name << ", seed 12, periodic " << static_cast<int>(periodic));
      expectRight(set.sites, repeated(periodic, set.domain));
    }
  }
}

TEST_P(PeriodicCells, haveTheDetailThatIsWanted) {
  const auto sites = generate(Pattern::clusters, 500, 2);
  const auto whole = expectRight(sites, repeated(Periodic::xy));
  const auto measures = expectRight(sites, repeated(Periodic::xy, unit, Detail::measures));
  EXPECT_EQ(measures.area, whole.area);
  EXPECT_EQ(measures.neighbors, whole.neighbors);
  EXPECT_EQ(measures.neighbor_shifts, whole.neighbor_shifts);
  EXPECT_TRUE(measures.vertices.empty() && measures.edge_lengths.empty() && measures.perimeter.empty() &&
              measures.second_moments.empty());
  EXPECT_EQ(whole.vertices.size(), whole.neighbors.size());
}

TEST_P(PeriodicCells, doNotDependOnThreadsOrSearch) {
  const auto sites = generate(Pattern::random, 2000, 2);
  const auto first = expectRight(sites, repeated(Periodic::xy));
  for (const int threads : {1, 3}) {
    auto chosen = backend(GetParam());
    chosen.threads = threads;
    auto session = open(chosen);
    const auto again = cells(session, sites, repeated(Periodic::xy));
    EXPECT_EQ(again.area, first.area);
    EXPECT_EQ(again.neighbors, first.neighbors);
    EXPECT_EQ(again.neighbor_shifts, first.neighbor_shifts);
  }
  auto lists = repeated(Periodic::xy);
  lists.search.method = Search::flann;
  EXPECT_TRUE(diffCells(expectRight(sites, lists), first)->agree());
}

TEST_P(PeriodicCells, ofBadInputAreRefused) {
  auto& session = sharedSession(GetParam());
  const auto refusal = [&](const Sites& bad, const CellsOptions& wanted) {
    const auto result = session.cells(bad, wanted);
    EXPECT_TRUE(!result && !result.error().message.empty());
    return result ? ErrorCode::device : result.error().code;
  };
  const auto wanted = repeated(Periodic::xy);
  EXPECT_EQ(refusal({}, wanted), ErrorCode::input);
  EXPECT_EQ(refusal({{0.5, std::nan("")}, {0.5, 0.5}, {}}, wanted), ErrorCode::input);
  EXPECT_EQ(refusal({{0.5, 1e20}, {0.5, 0.5}, {}}, wanted), ErrorCode::input);
  EXPECT_EQ(refusal({{0.5}, {0.5}, {}}, repeated(Periodic::xy, {0, 1, 1, 0})), ErrorCode::input);
  auto outlined = wanted;
  outlined.outline = {{{0, 0}, {1, 0}, {0, 1}}, {0, 3}, {0, 1}};
  EXPECT_EQ(refusal({{0.5}, {0.5}, {}}, outlined), ErrorCode::input);
  auto stopped = wanted;
  stopped.progress = [](auto, double) { return false; };
  EXPECT_EQ(refusal(generate(Pattern::random, 50, 1), stopped), ErrorCode::cancelled);
}

INSTANTIATE_TEST_SUITE_P(Backends, PeriodicCells, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test
