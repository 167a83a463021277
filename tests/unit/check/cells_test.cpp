#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "unit/fixtures/checked_runs.h"

namespace vorpipe::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The tests change `cells`, or `sites`, and see which promises are broken then.
class CheckCells : public ::testing::Test {
 protected:
  static const Diagram& rightCells() {
    static const Diagram right = cellsOf(mixedSites(), unit_cells);
    return right;
  }
  [[nodiscard]] std::vector<std::string> broken(Detail detail = Detail::everything) const {
    CellsOptions options = unit_cells;
    options.detail = detail;
    return promisesOf(check(sites, options, cells, 2));
  }
  /// The edges of a cell.
  [[nodiscard]] std::uint64_t begin(std::size_t site) const { return cells.cell_offsets[site]; }
  [[nodiscard]] std::uint64_t end(std::size_t site) const { return cells.cell_offsets[site + 1]; }
  /// An edge of a cell to another site.
  [[nodiscard]] std::uint64_t inner(std::size_t site) const {
    std::uint64_t edge = begin(site);
    while (cells.neighbors[edge] < 0) ++edge;
    return edge;
  }
  /// Moves a vertex in all cells that have it.
  void move(Point from, Point to) {
    for (Point& vertex : cells.vertices) {
      if (vertex.x == from.x && vertex.y == from.y) vertex = to;
    }
  }

  Sites sites = mixedSites();
  Diagram cells = rightCells();
};

TEST_F(CheckCells, FindsNothingInRightOnes) {
  for (const Detail detail : {Detail::measures, Detail::polygons, Detail::everything}) {
    EXPECT_THAT(broken(detail), IsEmpty());
  }
}

TEST_F(CheckCells, NeedNotHaveMoreThanTheDetail) {
  cells.triangles.clear();
  EXPECT_THAT(broken(Detail::polygons), IsEmpty());
  cells.vertices.clear();
  cells.edge_lengths.clear();
  cells.perimeter.clear();
  cells.second_moments.clear();
  EXPECT_THAT(broken(Detail::measures), IsEmpty());
  EXPECT_THAT(broken(Detail::polygons), ElementsAre("arrays"));
}

TEST_F(CheckCells, FindsWrongStatuses) {
  ASSERT_EQ(cells.status[200], Status::duplicate);
  ASSERT_EQ(cells.status[201], Status::ok);
  ASSERT_EQ(cells.status[202], Status::empty);
  cells.status[202] = Status::ok;
  EXPECT_THAT(broken(), Contains("statuses"));
  cells = rightCells();
  cells.status[200] = Status::ok;
  EXPECT_THAT(broken(), Contains("statuses"));
  cells = rightCells();
  cells.status[3] = Status::empty;
  EXPECT_THAT(broken(), Contains("statuses"));
  cells = rightCells();
  cells.report.ok += 1;
  EXPECT_THAT(broken(), ElementsAre("statuses"));
  cells = rightCells();
  cells.status.pop_back();
  EXPECT_THAT(broken(), ElementsAre("statuses"));
}

TEST_F(CheckCells, FindsWrongOwners) {
  cells.owner[200] = 200;
  EXPECT_THAT(broken(), ElementsAre("owners"));
  cells.owner[200] = 8;
  EXPECT_THAT(broken(), ElementsAre("owners"));
  cells = rightCells();
  cells.owner[3] = 5;
  EXPECT_THAT(broken(), ElementsAre("owners"));
}

TEST_F(CheckCells, FindsArraysOfTheWrongShape) {
  cells.area.push_back(0);
  EXPECT_THAT(broken(), ElementsAre("arrays"));
  cells = rightCells();
  cells.neighbors.pop_back();
  EXPECT_THAT(broken(), ElementsAre("arrays"));
  cells = rightCells();
  std::swap(cells.cell_offsets[3], cells.cell_offsets[4]);
  EXPECT_THAT(broken(), ElementsAre("arrays"));
  cells = rightCells();
  cells.neighbors[begin(4)] = 4;
  EXPECT_THAT(broken(), ElementsAre("neighbors"));
  for (const std::int64_t none : {-5, 200, 202, 203}) {
    cells.neighbors[begin(4)] = none;
    EXPECT_THAT(broken(), ElementsAre("neighbors")) << none;
  }
}

TEST_F(CheckCells, FindsWrongAreas) {
  cells.area[9] *= 1 + 1e-6;
  EXPECT_THAT(broken(), ElementsAre("areas", "polygons"));
  EXPECT_THAT(broken(Detail::measures), ElementsAre("areas"));
  cells.area[9] = nan;
  EXPECT_THAT(broken(), ElementsAre("areas", "polygons"));
  cells = rightCells();
  std::swap(cells.area[9], cells.area[10]);
  EXPECT_THAT(broken(), ElementsAre("polygons"));
  cells = rightCells();
  cells.area[202] = 1e-20;
  EXPECT_THAT(broken(), ElementsAre("cells"));
}

TEST_F(CheckCells, FindsWrongMeasures) {
  cells.perimeter[9] *= 1.001;
  EXPECT_THAT(broken(), ElementsAre("polygons"));
  cells = rightCells();
  cells.centroid[9].x += 1e-5;
  EXPECT_THAT(broken(), ElementsAre("polygons"));
  cells = rightCells();
  cells.second_moments[9][1] += 1e-9;
  EXPECT_THAT(broken(), ElementsAre("polygons"));
  cells = rightCells();
  cells.centroid[202] = {0, 0};
  EXPECT_THAT(broken(), ElementsAre("cells"));
}

TEST_F(CheckCells, FindsNeighborsThatDoNotNameEachOther) {
  const std::uint64_t edge = inner(20);
  cells.neighbors[edge] = cells.neighbors[edge] == 50 ? 51 : 50;
  EXPECT_THAT(broken(), Contains("symmetry"));
  EXPECT_THAT(broken(Detail::measures), ElementsAre("symmetry"));
  cells = rightCells();
  const std::uint64_t next = edge + 1 < end(20) ? edge + 1 : begin(20);
  cells.neighbors[next] = cells.neighbors[edge];
  EXPECT_THAT(broken(Detail::measures), ElementsAre("symmetry"));
}

TEST_F(CheckCells, FindsEdgesThatDifferBetweenTheirCells) {
  cells.edge_lengths[inner(20)] *= 1 + 1e-15;
  EXPECT_THAT(broken(), ElementsAre("symmetry"));
  cells = rightCells();
  Point& vertex = cells.vertices[inner(20)];
  vertex.x = std::nextafter(vertex.x, 2);
  EXPECT_THAT(broken(), ElementsAre("symmetry"));
}

TEST_F(CheckCells, FindsAVertexOffItsBisectors) {
  const Point vertex = cells.vertices[inner(20)];
  move(vertex, {vertex.x + 1e-4, vertex.y});
  EXPECT_THAT(broken(), Contains("polygons"));
}

TEST_F(CheckCells, FindsAWallOffTheDomain) {
  for (Point& vertex : cells.vertices) {
    if (vertex.x == 0) vertex.x = -1e-9;
  }
  EXPECT_THAT(broken(), Contains("polygons"));
}

TEST_F(CheckCells, FindsAClockwisePolygon) {
  const auto at = [&](auto& values, std::uint64_t edge) {
    return values.begin() + static_cast<std::ptrdiff_t>(edge);
  };
  std::reverse(at(cells.vertices, begin(20)), at(cells.vertices, end(20)));
  std::reverse(at(cells.neighbors, begin(20)), at(cells.neighbors, end(20)));
  std::reverse(at(cells.edge_lengths, begin(20)), at(cells.edge_lengths, end(20)));
  EXPECT_THAT(broken(), Contains("polygons"));
}

/// Neighbors out of order name each other still.
TEST_F(CheckCells, FindsWhatIsNoPartition) {
  std::swap(cells.neighbors[begin(20)], cells.neighbors[begin(20) + 1]);
  EXPECT_THAT(broken(Detail::measures), ElementsAre("Euler"));
}

TEST_F(CheckCells, FindsWrongTriangles) {
  cells.triangles.pop_back();
  EXPECT_THAT(broken(), ElementsAre("triangles"));
  cells.triangles.push_back(cells.triangles[0]);
  EXPECT_THAT(broken(), ElementsAre("triangles"));
  cells.triangles.clear();
  EXPECT_THAT(broken(), ElementsAre("triangles"));
  cells = rightCells();
  std::swap(cells.triangles[5][0], cells.triangles[5][1]);
  EXPECT_THAT(broken(), Contains("triangles"));
  cells = rightCells();
  cells.triangles[5][0] = 203;
  EXPECT_THAT(broken(), Contains("triangles"));
  cells = rightCells();
  cells.triangles[5] = {1, 2, 3};
  EXPECT_THAT(broken(), Contains("triangles"));
}

/// A cell that is missing, though all others are where it was: the site was not there.
TEST_F(CheckCells, FindsASiteWithoutItsCell) {
  sites.x[202] = 1.005;
  sites.y[202] = 0.25;
  cells.centroid[202] = {1.005, 0.25};
  EXPECT_THAT(broken(), Contains("nearest sites"));
}

TEST_F(CheckCells, FindsRecordsInAnotherOrder) {
  std::swap(sites.x[20], sites.x[50]);
  std::swap(sites.y[20], sites.y[50]);
  EXPECT_THAT(broken(Detail::measures), ElementsAre("nearest sites"));
  EXPECT_THAT(broken(), Contains("polygons"));
}

struct Scene {
  std::string name;
  Sites sites;
  Box domain{0, 0, 1, 1};
};

std::vector<Scene> rightScenes() {
  const auto scaled = [](double factor, double shift) {
    Sites sites = mixedSites();
    for (double& x : sites.x) x = x * factor + shift;
    for (double& y : sites.y) y = y * factor + shift;
    return sites;
  };
  Sites hub = generate(Pattern::circle, 3000, 1);
  hub.x.push_back(0.5);
  hub.y.push_back(0.5);
  return {{"one site", generate(Pattern::random, 1, 1)},
          {"two sites", generate(Pattern::random, 2, 1)},
          {"lattice", generate(Pattern::square, 900, 1)},
          {"hexagons", generate(Pattern::hex, 900, 1)},
          {"circle", generate(Pattern::circle, 500, 1)},
          {"circle and its center", hub},
          {"clusters", generate(Pattern::clusters, 2000, 1)},
          {"equal sites", {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, {}}},
          {"minus zero", {{0.0, -0.0, 0.5}, {0.5, 0.5, 0.5}, {}}},
          {"sites outside only", {{-3, -3, 4}, {0.5, 0.6, 9}, {}}},
          {"large", scaled(1e150, 0), {0, 0, 1e150, 1e150}},
          {"small", scaled(1e-150, 0), {0, 0, 1e-150, 1e-150}},
          {"far from the origin", scaled(1000, 5e6), {5e6, 5e6, 5e6 + 1000, 5e6 + 1000}},
          {"narrow", generate(Pattern::random, 5, 1), {0, 0, 1, 1e-9}},
          {"oblong", generate(Pattern::random, 500, 1), {0.4, 0.1, 0.4001, 0.9}}};
}

TEST(Check, TakesAnySiteThatDoubleDoesNotTellFromTheNearest) {
  CellsOptions options = unit_cells;
  options.domain = {-1, -1, 1, 1};
  for (const double apart : {1e-12, 1e-15, 1e-18, 1e-21}) {
    const Sites sites{{0, apart, 0, -apart, 0.5}, {0, 0, apart, -apart, 0.25}, {}};
    const auto lines = check(sites, options, cellsOf(sites, options));
    ASSERT_TRUE(lines);
    EXPECT_THAT(*lines, IsEmpty()) << apart;
  }
}

TEST(Check, FindsNothingInRightCellsOfAnyKind) {
  for (const Scene& scene : rightScenes()) {
    CellsOptions options = unit_cells;
    options.domain = scene.domain;
    const auto lines = check(scene.sites, options, cellsOf(scene.sites, options));
    ASSERT_TRUE(lines);
    EXPECT_THAT(*lines, IsEmpty()) << scene.name;
  }
}

TEST(Check, FindsTheSameForAnyNumberOfThreads) {
  const Sites sites = generate(Pattern::random, 20'000, 1);
  Diagram cells = cellsOf(sites, unit_cells);
  for (std::size_t i = 100; i < cells.area.size(); i += 1000) cells.perimeter[i] *= 2;
  const auto one = check(sites, unit_cells, cells, 1), many = check(sites, unit_cells, cells, 4);
  ASSERT_TRUE(one && many);
  EXPECT_EQ(*one, *many);
  ASSERT_EQ(one->size(), 1u);
  EXPECT_THAT(one->front(), ::testing::HasSubstr("site 100"));
  EXPECT_THAT(one->front(), ::testing::HasSubstr("the first of 20"));
}

}  // namespace
}  // namespace vorpipe::test
