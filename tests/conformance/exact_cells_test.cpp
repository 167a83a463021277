/// Whether the exact cells are right where they are known, and whether the comparison with them would
/// find what it is made for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/exact/exact_comparison.h"
#include "support/exact/exact_triangles.h"
#include "support/sites/data_sets.h"
#include "support/sites/unit.h"

namespace vorpipe::test {
namespace {

std::set<std::int64_t> neighborsOf(const ExactCells& cells, std::size_t i, double longer_than) {
  std::set<std::int64_t> neighbors;
  for (auto e = cells.offsets[i]; e < cells.offsets[i + 1]; ++e) {
    if (cells.edges[e].part > longer_than) neighbors.insert(cells.edges[e].neighbor);
  }
  return neighbors;
}

TEST(ExactCells, tileTheDomain) {
  for (const auto* kinds : {&dataSetKinds(), &weightedSetKinds()}) {
    for (const auto& kind : *kinds) {
      const auto set = makeDataSet(kind.name, 300, 3);
      const auto& d = set.domain;
      const double whole = (d.xmax - d.xmin) * (d.ymax - d.ymin);
      if (!std::isnormal(whole)) continue;
      const auto cells = exactCells(set.sites, d);
      EXPECT_NEAR(std::accumulate(cells.area.begin(), cells.area.end(), 0.0) / whole, 1, 1e-13) << kind.name;
    }
  }
}

TEST(ExactCells, ofALatticeAreItsSquares) {
  const auto cells = exactCells({{1, 3, 5, 1, 3, 5, 1, 3, 5}, {1, 1, 1, 3, 3, 3, 5, 5, 5}, {}}, {0, 0, 6, 6});
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(cells.area[i], 4);
  using Set = std::set<std::int64_t>;
  EXPECT_EQ(neighborsOf(cells, 4, 0), (Set{1, 3, 5, 7}));
  EXPECT_EQ(neighborsOf(cells, 0, 0), (Set{wall_xmin, wall_ymin, 1, 3}));
  EXPECT_EQ(neighborsOf(cells, 8, 0), (Set{wall_xmax, wall_ymax, 5, 7}));
  for (const auto& edge : cells.edges) EXPECT_EQ(edge.length, 2);
}

TEST(ExactCells, giveABisectorInAWallToTheWall) {
  const auto cells = exactCells({{-1, 1, 0.5, 0.5}, {0.5, 0.5, 5, -4}, {}}, unit);
  EXPECT_EQ(cells.area, (std::vector<double>{0, 1, 0, 0}));
  EXPECT_EQ(neighborsOf(cells, 1, 0), (std::set<std::int64_t>{-1, -2, -3, -4}));
  EXPECT_EQ(cells.edges.size(), 4u);
}

TEST(ExactCells, seeAnEdgeOfAnyLength) {
  for (const double far : {0.25 + 0x1p-50, 0.25, 0.25 - 0x1p-50}) {
    const auto cells = exactCells({{0.25, 0.75, 0.5, 0.5}, {0.5, 0.5, 0.5 + far, 0.5 - far}, {}}, unit);
    EXPECT_EQ(neighborsOf(cells, 0, 0).contains(1), far > 0.25);
    EXPECT_EQ(neighborsOf(cells, 2, 0).contains(3), far < 0.25);
  }
}

TEST(ExactCells, ofEqualSitesBelongToTheFirst) {
  const auto cells = exactCells({{0.5, 0.25, 0.5, -0.0, 0.0}, {0.5, 0.5, 0.5, 0.0, -0.0}, {}}, unit);
  EXPECT_EQ(cells.owner, (std::vector<std::uint32_t>{0, 1, 0, 3, 3}));
  EXPECT_EQ(cells.area[2], 0);
}

TEST(ExactCells, areThoseOfWeights) {
  const auto cells = exactCells({{0.25, 0.75, 2.25}, {0.5, 0.5, 0.5}, {0.25, 0, 2.25}}, unit);
  EXPECT_EQ(cells.area, (std::vector<double>{0.75, 0, 0.25}));
  EXPECT_EQ(cells.hidden, (std::vector<std::uint8_t>{0, 1, 0}));
  EXPECT_EQ(cells.triangles, 0u);
  EXPECT_EQ(neighborsOf(cells, 0, 0), (std::set<std::int64_t>{-1, -3, -4, 2}));
  EXPECT_EQ(neighborsOf(cells, 2, 0), (std::set<std::int64_t>{-2, -3, -4, 0}));
}

/// The one in the middle takes the octagon that is left of a square by its corners.
TEST(ExactCells, areThoseOfAHeavySiteAmongOthers) {
  const auto cells = exactCells({{0, 4, 0, 4, 2}, {0, 0, 4, 4, 2}, {0, 0, 0, 0, 4}}, {0, 0, 4, 4});
  EXPECT_EQ(cells.area, (std::vector<double>{0.5, 0.5, 0.5, 0.5, 14}));
  EXPECT_EQ(cells.triangles, 4u);
}

TEST(ExactCells, withoutAreaAreHidden) {
  for (const double off : {-0x1p-40, 0.0, 0x1p-40}) {
    SCOPED_TRACE(off);
    const Sites middle{{0, 4, 0, 4, 2}, {0, 0, 4, 4, 2}, {0, 0, 0, 0, -8 + off}};
    const auto cells = exactCells(middle, {0, 0, 4, 4});
    EXPECT_EQ(cells.hidden[4], off > 0 ? 0 : 1);
    EXPECT_EQ(cells.area[4] > 0, off > 0);
    EXPECT_EQ(cells.triangles, off > 0 ? 4u : 2u);
    EXPECT_EQ(neighborsOf(cells, 0, 0x1p-30), (std::set<std::int64_t>{-1, -3, 1, 2}));
    // Its cell would be a line.
    const Sites row{{0, 4, 2}, {0, 0, 0}, {0, 0, -4 + off}};
    EXPECT_EQ(exactCells(row, {0, 0, 4, 4}).hidden[2], off > 0 ? 0 : 1);
    const Sites side{{0, 4, 2, 2}, {0, 0, 0, 3}, {0, 0, -4 + off, 0}};
    EXPECT_EQ(exactCells(side, {0, 0, 4, 4}).hidden[2], off > 0 ? 0 : 1);
    EXPECT_EQ(exactCells(side, {0, 0, 4, 4}).triangles, off > 0 ? 2u : 1u);
    const Sites between{{0, 4, 2, 2, 2}, {0, 0, 0, 3, -3}, {0, 0, -4 + off, 0, 0}};
    EXPECT_EQ(exactCells(between, {0, 0, 4, 4}).hidden[2], off > 0 ? 0 : 1);
  }
}

TEST(ExactCells, ofEqualSitesBelongToTheHeaviest) {
  const auto cells =
      exactCells({{0.5, 0.25, 0.5, 0.5, 0.25}, {0.5, 0.5, 0.5, 0.5, 0.5}, {1, 1, 2, 2, -3}}, unit);
  EXPECT_EQ(cells.owner, (std::vector<std::uint32_t>{2, 1, 2, 2, 1}));
}

/// The exact cells as a diagram says them.
Diagram faithful(const ExactCells& exact) {
  Diagram diagram;
  diagram.owner = exact.owner;
  diagram.area = exact.area;
  diagram.cell_offsets = {0};
  for (std::size_t i = 0; i < exact.owner.size(); ++i) {
    for (auto e = exact.offsets[i]; e < exact.offsets[i + 1]; ++e) {
      if (exact.edges[e].part <= 1e-6) continue;
      diagram.neighbors.push_back(exact.edges[e].neighbor);
      diagram.edge_lengths.push_back(exact.edges[e].length);
    }
    diagram.cell_offsets.push_back(diagram.neighbors.size());
    const bool duplicate = exact.owner[i] != i;
    const bool empty = exact.offsets[i] == exact.offsets[i + 1];
    diagram.status.push_back(duplicate ? Status::duplicate : empty ? Status::empty : Status::ok);
    ++(duplicate ? diagram.report.duplicate : empty ? diagram.report.empty : diagram.report.ok);
  }
  return diagram;
}

/// The faults that the comparison finds in a diagram of duplicates, empty cells and walls, after `spoil`.
Comparison faultsAfter(const std::function<void(Diagram&)>& spoil) {
  auto set = makeDataSet("cropped", 400, 5);
  set.sites.x.push_back(set.sites.x[7]);
  set.sites.y.push_back(set.sites.y[7]);
  const auto exact = exactCells(set.sites, set.domain);
  auto diagram = faithful(exact);
  spoil(diagram);
  return compareWithExact(diagram, set.sites, set.domain, exact);
}

std::size_t firstOk(const Diagram& d) {
  return static_cast<std::size_t>(std::find(d.status.begin(), d.status.end(), Status::ok) - d.status.begin());
}

std::size_t firstBetweenSites(const Diagram& d) {
  return static_cast<std::size_t>(
      std::find_if(d.neighbors.begin(), d.neighbors.end(), [](auto n) { return n >= 0; }) -
      d.neighbors.begin());
}

TEST(ExactComparison, acceptsTheExactCells) {
  const auto comparison = faultsAfter([](Diagram&) {});
  EXPECT_TRUE(comparison.agree()) << comparison.summary() << ": " << comparison.first.front();
  EXPECT_EQ(comparison.summary(), "agrees");
}

TEST(ExactComparison, findsAnAreaOffByMoreThanPromised) {
  EXPECT_EQ(faultsAfter([](Diagram& d) { d.area[firstOk(d)] *= 1 + 1.1e-5; }).areas, 1u);
  EXPECT_EQ(faultsAfter([](Diagram& d) { d.area[firstOk(d)] *= 1 - 1.1e-5; }).areas, 1u);
  EXPECT_EQ(faultsAfter([](Diagram& d) { d.area[firstOk(d)] = std::nan(""); }).areas, 1u);
  EXPECT_TRUE(faultsAfter([](Diagram& d) { d.area[firstOk(d)] *= 1 + 0.9e-5; }).agree());
}

TEST(ExactComparison, findsANeighborTooManyOrTooFew) {
  const auto other = faultsAfter(
      [](Diagram& d) { d.neighbors[firstBetweenSites(d)] = static_cast<std::int64_t>(d.status.size()) - 1; });
  EXPECT_EQ(other.missing, 1u);
  EXPECT_EQ(other.invented, 1u);
  EXPECT_EQ(other.one_sided, 2u);
  const auto wall =
      faultsAfter([](Diagram& d) { *std::find(d.neighbors.begin(), d.neighbors.end(), -1) = -2; });
  EXPECT_EQ(wall.missing, 1u);
  EXPECT_GE(wall.invented, 1u);
  const auto twice = faultsAfter([](Diagram& d) {
    d.neighbors[d.cell_offsets[firstOk(d)]] = d.neighbors[d.cell_offsets[firstOk(d)] + 1];
  });
  EXPECT_GE(twice.invented, 1u);
}

TEST(ExactComparison, findsATieThatIsReported) {
  const Sites sites{{0.25, 0.75, 0.5, 0.5}, {0.5, 0.5, 0.75 + 1e-7, 0.25 - 1e-7}, {}};
  const auto exact = exactCells(sites, unit);
  auto diagram = faithful(exact);
  EXPECT_TRUE(compareWithExact(diagram, sites, unit, exact).agree());
  diagram.neighbors.insert(diagram.neighbors.begin(), 1);
  diagram.edge_lengths.insert(diagram.edge_lengths.begin(), 1e-7);
  for (std::size_t i = 1; i < 5; ++i) ++diagram.cell_offsets[i];
  EXPECT_EQ(compareWithExact(diagram, sites, unit, exact).invented, 1u);
}

TEST(ExactComparison, findsAWrongStatusOwnerOrCount) {
  EXPECT_EQ(
      faultsAfter([](Diagram& d) { d.owner.back() = static_cast<std::uint32_t>(d.owner.size() - 1); }).cells,
      1u);
  EXPECT_GE(faultsAfter([](Diagram& d) { d.status.back() = Status::empty; }).cells, 1u);
  EXPECT_GE(faultsAfter([](Diagram& d) { d.status[firstOk(d)] = Status::empty; }).cells, 2u);
  EXPECT_GE(faultsAfter([](Diagram& d) {
              *std::find(d.status.begin(), d.status.end(), Status::empty) = Status::ok;
            }).cells,
            1u);
  EXPECT_EQ(faultsAfter([](Diagram& d) { ++d.report.empty; }).cells, 1u);
  EXPECT_EQ(faultsAfter([](Diagram& d) { d.cell_offsets.pop_back(); }).cells, 1u);
}

TEST(ExactComparison, findsAWrongLength) {
  EXPECT_EQ(faultsAfter([](Diagram& d) { d.edge_lengths[firstBetweenSites(d)] *= 1.001; }).lengths, 1u);
}

TriangleFaults triangleFaultsAfter(const std::function<void(Diagram&)>& spoil) {
  BackendOptions cpu;
  cpu.name = "cpu";
  auto session = Session::open(cpu);
  EXPECT_TRUE(session) << session.error().message;
  const auto sites = generate(Pattern::random, 200, 9);
  CellsOptions options{};
  options.domain = unit;
  auto diagram = session->cells(sites, options);
  EXPECT_TRUE(diagram) << diagram.error().message;
  spoil(*diagram);
  return findTriangleFaults(*diagram, sites, unit, exactCells(sites, unit));
}

TEST(TriangleFaults, areNoneInADelaunayTriangulation) {
  EXPECT_TRUE(triangleFaultsAfter([](Diagram&) {}).none());
}

TEST(TriangleFaults, areFound) {
  EXPECT_EQ(triangleFaultsAfter([](Diagram& d) { std::swap(d.triangles[5][0], d.triangles[5][1]); }).turned,
            1u);
  EXPECT_EQ(triangleFaultsAfter([](Diagram& d) { d.triangles[5][0] = 200; }).turned, 1u);
  EXPECT_EQ(triangleFaultsAfter([](Diagram& d) { d.triangles.push_back(d.triangles[5]); }).overlapping, 3u);
  EXPECT_GE(triangleFaultsAfter([](Diagram& d) { d.triangles.pop_back(); }).missing, 1u);
}

TEST(TriangleFaults, haveAHiddenSite) {
  const Sites sites{{0, 4, 0, 4, 2}, {0, 0, 4, 4, 2}, {0, 0, 0, 0, -8}};
  Diagram diagram;
  diagram.status.assign(5, Status::ok);
  diagram.cell_offsets.assign(6, 0);
  const auto faults = [&] { return findTriangleFaults(diagram, sites, unit, exactCells(sites, unit)); };
  diagram.triangles = {{0, 1, 3}, {0, 3, 2}};
  EXPECT_TRUE(faults().none());
  diagram.triangles = {{0, 1, 4}, {1, 3, 4}, {2, 4, 3}, {0, 4, 2}};
  EXPECT_EQ(faults().turned, 4u);
  EXPECT_EQ(faults().missing, 1u);
}

TEST(TriangleFaults, haveAnEdgeThatWeightsTurn) {
  const Sites sites{{0.2, 0.8, 0.5, 0.5}, {0.5, 0.5, 0.6, 0.4}, {0.1, 0.1, 0, 0}};
  Diagram diagram;
  diagram.status.assign(4, Status::ok);
  diagram.cell_offsets.assign(5, 0);
  diagram.triangles = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_TRUE(findTriangleFaults(diagram, sites, unit, exactCells(sites, unit)).none());
  diagram.triangles = {{0, 3, 2}, {1, 2, 3}};
  EXPECT_EQ(findTriangleFaults(diagram, sites, unit, exactCells(sites, unit)).not_local, 1u);
}

TEST(TriangleFaults, haveAnEdgeThatIsNotDelaunay) {
  const Sites sites{{0.2, 0.8, 0.5, 0.5}, {0.5, 0.5, 0.6, 0.4}, {}};
  Diagram diagram;
  diagram.status.assign(4, Status::ok);
  diagram.cell_offsets.assign(5, 0);
  diagram.triangles = {{0, 3, 2}, {1, 2, 3}};
  EXPECT_TRUE(findTriangleFaults(diagram, sites, unit, exactCells(sites, unit)).none());
  diagram.triangles = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_EQ(findTriangleFaults(diagram, sites, unit, exactCells(sites, unit)).not_local, 1u);
}

}  // namespace
}  // namespace vorpipe::test
