/// Vertices and edges that cells share.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/sites/random_sites.h"
#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {
namespace {

using testing::Each;
using testing::ElementsAre;

Topology sharedBy(const Diagram& diagram) {
  auto topology = topologyOf(diagram);
  EXPECT_TRUE(topology) << topology.error().message;
  return topology ? std::move(*topology) : Topology{};
}

/// Vertices less edges plus faces: a piece of a cell counts 1, less its holes.
std::int64_t eulerNumber(const Diagram& diagram, const Topology& topology) {
  auto number = static_cast<std::int64_t>(topology.vertices.size()) -
                static_cast<std::int64_t>(topology.edge_entry.size());
  for (const Cell cell : diagram) {
    const CellRings rings = cell.rings();
    for (std::size_t r = 0; r < rings.size(); ++r) number += rings.isHole(r) ? -1 : 1;
  }
  return number;
}

/// Each entry has its vertex and its edge, and each edge the sides that it should.
void expectWhole(const Diagram& diagram, const Topology& topology) {
  ASSERT_EQ(topology.vertex_of.size(), diagram.vertices.size());
  ASSERT_EQ(topology.edge_of.size(), diagram.vertices.size());
  const bool repeats = !diagram.neighbor_shifts.empty();
  std::vector<int> sides(topology.edge_entry.size());
  for (const Cell cell : diagram) {
    const CellRings rings = cell.rings();
    for (std::size_t r = 0; r < rings.size(); ++r) {
      for (auto entry = rings.begin(r); entry < rings.end(r); ++entry) {
        const auto from = topology.vertex_of[entry];
        const auto to = topology.vertex_of[entry + 1 < rings.end(r) ? entry + 1 : rings.begin(r)];
        const auto edge = topology.edge_of[entry];
        ++sides[edge];
        const auto& ends = topology.edge_vertices[edge];
        const auto& cells = topology.edge_cells[edge];
        const auto own = static_cast<std::int64_t>(cell.index());
        const bool first = topology.edge_entry[edge] == entry;
        EXPECT_EQ(cells[first ? 0 : 1], own);
        EXPECT_EQ(cells[first ? 1 : 0], diagram.neighbors[entry]);
        EXPECT_THAT(ends, first ? ElementsAre(from, to) : ElementsAre(to, from));
        EXPECT_TRUE(repeats || topology.vertices[from] == diagram.vertices[entry]);
      }
    }
  }
  for (std::size_t edge = 0; edge < sides.size(); ++edge) {
    EXPECT_EQ(sides[edge], topology.isBoundary(edge) ? 1 : 2) << edge;
  }
  EXPECT_TRUE(std::ranges::is_sorted(topology.edge_entry));
}

std::size_t boundaryEdges(const Topology& topology) {
  std::size_t count = 0;
  for (std::size_t edge = 0; edge < topology.edge_entry.size(); ++edge) count += topology.isBoundary(edge);
  return count;
}

CellsOptions repeated(Periodic periodic) {
  CellsOptions options = unit_cells;
  options.periodic = periodic;
  return options;
}

Sites withWeights(Sites sites, std::uint64_t seed) {
  Random random(seed);
  const double most = 4 / static_cast<double>(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(most * random.uniform());
  return sites;
}

TEST(Topology, ofABoxIsThatOfADisk) {
  for (const auto pattern : {Pattern::random, Pattern::square, Pattern::hex, Pattern::jitter,
                             Pattern::clusters, Pattern::circle}) {
    SCOPED_TRACE(static_cast<int>(pattern));
    const Diagram diagram = cellsOf(generate(pattern, 2000, 3), unit_cells);
    const Topology topology = sharedBy(diagram);
    expectWhole(diagram, topology);
    EXPECT_EQ(eulerNumber(diagram, topology), 1);
  }
  for (const Sites& sites : {mixedSites(), withWeights(mixedSites(), 4)}) {
    const Diagram diagram = cellsOf(sites, unit_cells);
    const Topology topology = sharedBy(diagram);
    expectWhole(diagram, topology);
    EXPECT_EQ(eulerNumber(diagram, topology), 1);
  }
}

TEST(Topology, ofALatticeHasItsNumbers) {
  const std::size_t side = 20;
  const Sites sites = generate(Pattern::square, side * side, 1);
  const Topology box = sharedBy(cellsOf(sites, unit_cells));
  EXPECT_EQ(box.vertices.size(), (side + 1) * (side + 1));
  EXPECT_EQ(box.edge_entry.size(), 2 * side * (side + 1));
  EXPECT_EQ(boundaryEdges(box), 4 * side);
  const Topology torus = sharedBy(cellsOf(sites, repeated(Periodic::xy)));
  EXPECT_EQ(torus.vertices.size(), side * side);
  EXPECT_EQ(torus.edge_entry.size(), 2 * side * side);
  EXPECT_EQ(boundaryEdges(torus), 0u);
  const Topology band = sharedBy(cellsOf(sites, repeated(Periodic::x)));
  EXPECT_EQ(band.vertices.size(), side * (side + 1));
  EXPECT_EQ(boundaryEdges(band), 2 * side);
}

TEST(Topology, ofManySitesHasThreeEdgesForTwoVertices) {
  const std::size_t count = 500;
  const Diagram diagram = cellsOf(generate(Pattern::random, count, 8), repeated(Periodic::xy));
  const Topology topology = sharedBy(diagram);
  // But for ties, of which random sites have none.
  EXPECT_EQ(topology.vertices.size(), 2 * count);
  EXPECT_EQ(topology.edge_entry.size(), 3 * count);
}

TEST(Topology, ofAPeriodicDomainIsThatOfARing) {
  for (const auto periodic : {Periodic::x, Periodic::y, Periodic::xy}) {
    for (const std::uint64_t count : {1U, 2U, 3U, 10U, 1000U}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(periodic) << ", sites: " << count);
      for (const Sites& sites : {generate(Pattern::random, count, 5), generate(Pattern::hex, count, 1),
                                 withWeights(generate(Pattern::random, count, 6), 7)}) {
        const Diagram diagram = cellsOf(sites, repeated(periodic));
        const Topology topology = sharedBy(diagram);
        expectWhole(diagram, topology);
        EXPECT_EQ(eulerNumber(diagram, topology), 0);
      }
    }
  }
}

TEST(Topology, ofOneSiteOnATorusIsASquareWithItselfAround) {
  Sites sites;
  sites.x = {0.25};
  sites.y = {0.75};
  const Topology topology = sharedBy(cellsOf(sites, repeated(Periodic::xy)));
  EXPECT_EQ(topology.vertices.size(), 1u);
  ASSERT_EQ(topology.edge_entry.size(), 2u);
  EXPECT_THAT(topology.edge_cells, Each(ElementsAre(0, 0)));
}

TEST(Topology, ofAnOutlineHasItsHolesAndIslands) {
  const Outline frame =
      outlineOf({{rectangle(0.125, 0.125, 0.875, 0.875), rectangle(0.375, 0.375, 0.625, 0.625)}});
  for (const std::uint64_t count : {1U, 2U, 7U, 500U}) {
    SCOPED_TRACE(count);
    const Sites sites = generate(Pattern::random, count, 2);
    const Diagram of_frame = cellsOf(sites, inside(frame)),
                  of_country = cellsOf(sites, inside(country(1000)));
    const Topology on_frame = sharedBy(of_frame), on_country = sharedBy(of_country);
    expectWhole(of_frame, on_frame);
    expectWhole(of_country, on_country);
    EXPECT_EQ(eulerNumber(of_frame, on_frame), 0);
    // Four polygons with three holes.
    EXPECT_EQ(eulerNumber(of_country, on_country), 1);
  }
}

TEST(Topology, hasSeveralEdgesBetweenTwoCellsWhereAnOutlineCutsThem) {
  Sites sites;
  sites.x = {0.25, 0.75};
  sites.y = {0.5, 0.5};
  const Topology topology = sharedBy(
      cellsOf(sites, inside(outlineOf({{rectangle(0, 0, 1, 1), rectangle(0.375, 0.375, 0.625, 0.625)}}))));
  const auto between = std::ranges::count_if(
      topology.edge_cells, [](const auto& cells) { return cells[0] == 0 && cells[1] == 1; });
  EXPECT_EQ(between, 2);
  EXPECT_EQ(topology.edge_entry.size(), 2u + 6u + 6u);
}

TEST(Topology, isWholeForAnySites) {
  const std::uint64_t seed = std::random_device{}();
  std::cout << "[   SEED   ] " << seed << std::endl;
  Random random(seed);
  for (int run = 0; run < 40; ++run) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", run " << run);
    // On a coarse grid, so that there are ties and duplicates.
    Sites sites;
    const double steps = run % 2 == 0 ? 16 : 0x1p40;
    for (std::uint64_t left = 1 + random.below(200); left > 0; --left) {
      const double x = std::floor(random.uniform() * steps) / steps;
      add(sites, {x, std::floor(random.uniform() * steps) / steps});
    }
    if (run % 3 == 0) sites = withWeights(std::move(sites), random());
    const auto periodic = static_cast<Periodic>(random.below(4));
    const Diagram diagram = cellsOf(sites, repeated(periodic));
    const Topology topology = sharedBy(diagram);
    expectWhole(diagram, topology);
    EXPECT_EQ(eulerNumber(diagram, topology), periodic == Periodic::none ? 1 : 0);
  }
}

TEST(Topology, doesNotDependOnThreads) {
  const Diagram diagram = cellsOf(generate(Pattern::clusters, 20'000, 3), unit_cells);
  const auto one = topologyOf(diagram, 1), four = topologyOf(diagram, 4);
  EXPECT_EQ(one->edge_of, four->edge_of);
  EXPECT_EQ(one->edge_cells, four->edge_cells);
}

TEST(Topology, namesTheVerticesAndEdgesOfACell) {
  const Diagram diagram = cellsOf(generate(Pattern::square, 9, 1), unit_cells);
  const Topology topology = sharedBy(diagram);
  const Cell middle = diagram.cell(4);
  ASSERT_EQ(middle.edges(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(topology.vertices[topology.verticesOf(middle)[k]], middle.vertices()[k]);
    EXPECT_THAT(topology.edge_cells[topology.edgesOf(middle)[k]], testing::Contains(middle.neighbors()[k]));
  }
}

TEST(Topology, needsPolygons) {
  CellsOptions options = unit_cells;
  options.detail = Detail::measures;
  const auto topology = topologyOf(cellsOf(generate(Pattern::square, 9, 1), options));
  ASSERT_FALSE(topology);
  EXPECT_EQ(topology.error().code, ErrorCode::input);
  EXPECT_EQ(topology.error().message,
            "the diagram has 36 neighbors and 0 vertices: topology takes Detail::polygons");
}

TEST(Topology, isRefusedWhereCellsDisagree) {
  Diagram diagram = cellsOf(generate(Pattern::square, 9, 1), unit_cells);
  std::ranges::replace(diagram.neighbors, 4, 5);
  const auto topology = topologyOf(diagram);
  ASSERT_FALSE(topology);
  EXPECT_EQ(topology.error().message, "sites 1 and 5 do not have the same edges with each other");
}

TEST(DistinctPoints, joinsEqualOnesInTheirOrder) {
  const double next = std::nextafter(1.0, 2.0);
  const std::vector<Point> points{{1, 0}, {0, 1}, {1, -0.0}, {next, 0}, {0, 1}};
  const auto distinct = distinctPoints(points);
  ASSERT_TRUE(distinct);
  EXPECT_THAT(distinct->points, ElementsAre(Point{1, 0}, Point{0, 1}, Point{next, 0}));
  EXPECT_THAT(distinct->index_of, ElementsAre(0u, 1u, 0u, 2u, 1u));
}

}  // namespace
}  // namespace vorpipe::test
