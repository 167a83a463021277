#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "globe/sphere_cells.h"
#include "globe/sphere_mesh.h"
#include "support/sites/globe_sites.h"
#include "unit/fixtures/checked_runs.h"

namespace vorpipe::test {
namespace {

using ::testing::Contains;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr double whole_sphere = 4 * std::numbers::pi;

std::vector<std::int64_t> neighborsAround(const Diagram& cells, std::size_t site) {
  const auto neighbors = cells.cell(site).neighbors();
  return {neighbors.begin(), neighbors.end()};
}

TEST(GlobeCellsOf, OneSiteAreTheWholeEarth) {
  const Diagram cells = cellsOf({{10}, {20}, {}}, ofGlobe());
  EXPECT_EQ(cells.status[0], Status::ok);
  EXPECT_NEAR(cells.solid_angle[0], whole_sphere, 1e-14);
  EXPECT_NEAR(cells.area[0], 510065621.724, 1e-3);
  EXPECT_EQ(cells.cell(0).edges(), 0u);
}

TEST(GlobeCellsOf, TwoSitesAreHalvesWithOneEdge) {
  const Diagram cells = cellsOf({{10, -170}, {20, -20}, {}}, ofGlobe());
  EXPECT_THAT(cells.solid_angle, Each(DoubleNear(whole_sphere / 2, 1e-14)));
  EXPECT_THAT(neighborsAround(cells, 0), ElementsAre(1));
  EXPECT_NEAR(cells.edge_lengths[0], 2 * std::numbers::pi * 6371.0071809, 1e-6);
  // Across the equator the sphere and the ellipsoid are as symmetric.
  EXPECT_NEAR(cells.area[0] / cells.area[1], 1, 1e-14);
}

TEST(GlobeCellsOf, SitesOnACircleAreSlices) {
  const Diagram cells = cellsOf({{0, 90, 180, -90}, {50, 50, 50, 50}, {}}, ofGlobe());
  EXPECT_THAT(cells.solid_angle, Each(DoubleNear(std::numbers::pi, 1e-13)));
  EXPECT_THAT(neighborsAround(cells, 0), ElementsAre(1, 3));
  EXPECT_TRUE(cells.triangles.empty());
  for (const Point vertex : cells.vertices) EXPECT_NEAR(std::abs(vertex.y), 90, 1e-12);
}

TEST(GlobeCellsOf, LatticesHaveTheirSquares) {
  const Diagram cube = cellsOf(
      {{45, 135, -135, -45, 45, 135, -135, -45}, {30, 30, 30, 30, -30, -30, -30, -30}, {}}, ofGlobe());
  EXPECT_THAT(neighborsAround(cube, 0), UnorderedElementsAre(1, 3, 4));
  const Sites grid = degreeGrid(2, true);
  const Diagram cells = cellsOf(grid, ofGlobe());
  // 180 sites are at each pole, and one owns the cell.
  EXPECT_EQ(cells.report.duplicate, 358u);
  EXPECT_EQ(cells.cell(0).edges(), 180u);
  EXPECT_THAT(cells.owner, testing::Contains(0u).Times(180));
  EXPECT_EQ(cells.cell(200).edges(), 4u);
}

TEST(GlobeCellsOf, LongitudesOfAnyTurnAreTheSame) {
  const Diagram cells = cellsOf({{190, 30, -80}, {10, 20, -40}, {}}, ofGlobe()),
                turned = cellsOf({{-170, -330, 280}, {10, 20, -40}, {}}, ofGlobe());
  EXPECT_EQ(cells.vertices, turned.vertices);
  EXPECT_EQ(cells.area, turned.area);
}

TEST(GlobeCellsOf, EqualWeightsAreNone) {
  Sites sites = randomOnGlobe(300, 4);
  const Diagram bare = cellsOf(sites, ofGlobe());
  sites.weight.assign(sites.size(), 1e5);
  const Diagram equal = cellsOf(sites, ofGlobe());
  EXPECT_EQ(bare.neighbors, equal.neighbors);
  for (std::size_t i = 0; i < sites.size(); ++i)
    EXPECT_NEAR(bare.solid_angle[i], equal.solid_angle[i], 1e-13);
}

TEST(GlobeCellsOf, TwoWeightsAtAPlaceLeaveTheHeavier) {
  Sites sites = randomOnGlobe(40, 5);
  sites.x.push_back(sites.x[3]);
  sites.y.push_back(sites.y[3]);
  sites.weight.assign(41, 0);
  sites.weight[40] = 1e4;
  const Diagram cells = cellsOf(sites, ofGlobe());
  EXPECT_EQ(cells.status[3], Status::duplicate);
  EXPECT_EQ(cells.owner[3], 40u);
  EXPECT_EQ(cells.status[40], Status::ok);
}

TEST(GlobeCellsOf, AHeavySiteHidesOthers) {
  const Diagram cells = cellsOf({{0, 1, 180, 90}, {0, 0, 0, 0}, {4e6, 0, 0, 0}}, ofGlobe());
  EXPECT_EQ(cells.status[1], Status::empty);
  EXPECT_EQ(cells.report.hidden, 1u);
}

TEST(GlobeCells, RefuseWhatIsNoPlace) {
  const auto refused = [](const Sites& sites, const CellsOptions& options = ofGlobe()) {
    const auto cells = cpuSession().cells(sites, options);
    EXPECT_FALSE(cells);
    return cells ? "" : cells.error().message;
  };
  EXPECT_THAT(refused({{0}, {91}, {}}), testing::HasSubstr("site 0"));
  EXPECT_THAT(refused({{0, 0}, {0, 1}, {0, 1.01e8}}), testing::HasSubstr("site 1: weight 101000000"));
  CellsOptions flann = ofGlobe();
  flann.search.method = Search::flann;
  EXPECT_THAT(refused({{0}, {0}, {}}, flann), testing::HasSubstr("not on the globe"));
  CellsOptions stopped = ofGlobe();
  stopped.progress = [](std::string_view, double part) { return part < 0.5; };
  EXPECT_THAT(refused(randomOnGlobe(100, 1), stopped), testing::HasSubstr("interrupted"));
}

/// The directions of sites turned by each of the rotations of a cube; exactly, as in degrees only turns
/// around the poles are.
std::vector<core::SphereSites> turned(const Sites& sites) {
  std::vector<core::SphereSites> turns;
  std::array<int, 3> axes{0, 1, 2};
  do {
    for (unsigned signs = 0; signs < 8; ++signs) {
      const auto signOf = [signs](int k) { return (signs >> k & 1u) != 0 ? -1.0 : 1.0; };
      const int inversions = (axes[0] > axes[1]) + (axes[0] > axes[2]) + (axes[1] > axes[2]);
      if (signOf(0) * signOf(1) * signOf(2) * (inversions % 2 == 0 ? 1 : -1) < 0) continue;
      auto& turn = turns.emplace_back();
      for (std::size_t i = 0; i < sites.size(); ++i) {
        const core::Direction d = core::directionOf({sites.x[i], sites.y[i]});
        const std::array from{d.x, d.y, d.z};
        const auto at = [&](std::size_t k) {
          return signOf(static_cast<int>(k)) * from[static_cast<std::size_t>(axes[k])];
        };
        turn.direction.push_back({at(0), at(1), at(2)});
      }
    }
  } while (std::ranges::next_permutation(axes).found);
  return turns;
}

TEST(SphereCells, TurnWithTheirSites) {
  std::vector<GlobeSet> sets = tightOnGlobe();
  sets.push_back({"random", randomOnGlobe(2000, 6)});
  for (const GlobeSet& set : sets) {
    SCOPED_TRACE(set.name);
    const auto rowsOf = [](const core::SphereSites& of) {
      const auto mesh = core::triangulateSphere(of, 1);
      const auto cells = core::cellsOfSphere(of, *mesh, false, 1);
      std::vector<std::vector<std::int64_t>> rows(of.direction.size());
      cells->visit(0, cells->steps(), [&](const core::SphereCell& cell) {
        rows[cell.site].assign(cell.neighbor.begin(), cell.neighbor.end());
      });
      return rows;
    };
    const auto turns = turned(set.sites);
    EXPECT_EQ(turns.size(), 24u);
    const auto rows = rowsOf(turns.front());
    for (const core::SphereSites& turn : turns) EXPECT_EQ(rowsOf(turn), rows);
  }
}

/// The rings of an outline.
std::vector<std::vector<Point>> ringsInDegrees(const Outline& outline) {
  std::vector<std::vector<Point>> rings;
  for (std::size_t r = 0; r + 1 < outline.ring_offsets.size(); ++r) {
    const auto point = [&](std::uint64_t k) {
      return outline.points.begin() + static_cast<std::ptrdiff_t>(k);
    };
    rings.emplace_back(point(outline.ring_offsets[r]), point(outline.ring_offsets[r + 1]));
  }
  return rings;
}

/// The area in square degrees of rings of longitude and latitude.
double areaInDegrees(const std::vector<std::vector<Point>>& rings) {
  double twice = 0;
  for (const auto& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point a = ring[k], b = ring[(k + 1) % ring.size()];
      twice += a.x * b.y - b.x * a.y;
    }
  }
  return twice / 2;
}

TEST(GlobePolygons, FillTheMapOnce) {
  for (const GlobeSet& set : hardOnGlobe()) {
    SCOPED_TRACE(set.name);
    const Diagram cells = cellsOf(set.sites, ofGlobe());
    double sum = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto polygons = ringsInDegrees(globePolygons(set.sites, cells, i));
      EXPECT_EQ(polygons.empty(), cells.status[i] != Status::ok);
      for (const auto& ring : polygons) {
        EXPECT_GE(ring.size(), 3u);
        for (const Point p : ring)
          EXPECT_TRUE(std::abs(p.x) <= 180 && std::abs(p.y) <= 90) << p.x << " " << p.y;
      }
      sum += areaInDegrees(polygons);
    }
    EXPECT_NEAR(sum, 360 * 180, 1e-6);
  }
}

TEST(GlobeLines, AreGreatCirclesCutAt180Degrees) {
  const auto way = globeWay({170, 10}, {-170, 10});
  EXPECT_EQ(way.front(), (Point{170, 10}));
  EXPECT_NEAR(way.back().x, 190, 1e-12);
  EXPECT_GT(std::ranges::max(way, {}, &Point::y).y, 10.1);
  const auto parts = cutAtTurns(way);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].back().x, 180);
  EXPECT_EQ(parts[1].front().x, -180);
  EXPECT_NEAR(globeDistance({0, 0}, {0, 90}), 10007.55468, 1e-4);
  // Over a pole, and from it.
  EXPECT_EQ(std::ranges::max(globeWay({0, 80}, {180, 80}), {}, &Point::y).y, 90);
  EXPECT_NEAR(globeWay({0, 90}, {50, 10}).front().x, 50, 1e-12);
}

TEST(GlobeLines, AreInBothCells) {
  const Sites sites = randomOnGlobe(20, 8);
  const Diagram cells = cellsOf(sites, ofGlobe());
  std::vector<Point3> own, others;
  for (const Cell cell : cells) {
    const GlobeBorder border = globeBorder(sites, cells, cell.index(), 5);
    EXPECT_EQ(border.begins.size(), cell.edges());
    (cell.index() == 0 ? own : others)
        .insert((cell.index() == 0 ? own : others).end(), border.points.begin(), border.points.end());
  }
  for (const Point3& point : own) {
    EXPECT_THAT(others, Contains(point));
    EXPECT_NEAR(std::hypot(point.x, point.y, point.z), 1, 1e-15);
  }
}

TEST(GlobeLocator, FindsTheNearestSite) {
  for (const bool has_weights : {false, true}) {
    Sites sites = randomOnGlobe(300, 9);
    append(sites, Sites(sites));
    if (has_weights) sites = capsOf(sites, -1e5, 2e6, 10);
    const Diagram cells = cellsOf(sites, ofGlobe());
    auto locator = Locator::make(sites, ofGlobe());
    ASSERT_TRUE(locator);
    Random random(11);
    std::vector<double> counted(sites.size());
    constexpr std::size_t count = 20000;
    for (std::size_t k = 0; k < count; ++k) {
      const Point place{noise(random, 400), std::asin(noise(random, 1)) * 180 / std::numbers::pi};
      const auto site = locator->at(place);
      ASSERT_LT(site, sites.size());
      EXPECT_EQ(cells.status[site], Status::ok);
      ++counted[site];
    }
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const double part = cells.solid_angle[i] / whole_sphere;
      EXPECT_NEAR(counted[i] / count, part, 6 * std::sqrt(part / count) + 1e-3);
    }
    EXPECT_EQ(locator->at({0, 91}), no_site);
    EXPECT_EQ(locator->at({std::nan(""), 0}), no_site);
    for (std::size_t i = 0; !has_weights && i < sites.size(); ++i)
      EXPECT_EQ(locator->at({sites.x[i] + 360, sites.y[i]}), cells.owner[i]);
  }
}

/// The tests change `cells` and see which promises are broken then.
class CheckGlobe : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> broken() const {
    return promisesOf(check(sites, ofGlobe(), cells, 2));
  }
  [[nodiscard]] std::size_t begin(std::size_t site) const { return cells.cell_offsets[site]; }

  Sites sites = joinedSites(randomOnGlobe(200, 12), {{45, 45}, {30, 30}, {}});
  Diagram cells = cellsOf(sites, ofGlobe());
};

TEST_F(CheckGlobe, FindsNothingInRightOnes) { EXPECT_THAT(broken(), IsEmpty()); }

TEST_F(CheckGlobe, FindsWrongAreas) {
  cells.area[7] *= 1 + 1e-6;
  EXPECT_THAT(broken(), ElementsAre("areas"));
  cells = cellsOf(sites, ofGlobe());
  cells.solid_angle[7] *= 1 + 1e-6;
  EXPECT_THAT(broken(), ElementsAre("areas"));
}

TEST_F(CheckGlobe, FindsWrongOwners) {
  ASSERT_EQ(cells.status[201], Status::duplicate);
  cells.owner[201] = 7;
  EXPECT_THAT(broken(), Contains("owners"));
  cells = cellsOf(sites, ofGlobe());
  cells.status[3] = Status::empty;
  EXPECT_THAT(broken(), ElementsAre("neighbors"));
}

TEST_F(CheckGlobe, FindsANeighborOnOneSideAlone) {
  std::swap(cells.neighbors[begin(5)], cells.neighbors[begin(5) + 1]);
  EXPECT_THAT(broken(), Contains("symmetry"));
}

TEST_F(CheckGlobe, FindsAVertexElsewhere) {
  const Point from = cells.vertices[begin(9)];
  for (Point& vertex : cells.vertices) {
    if (vertex == from) vertex.y += 1e-3;
  }
  EXPECT_THAT(broken(), Contains("nearest"));
}

TEST_F(CheckGlobe, FindsSitesThatHaveMoved) {
  std::swap(sites.x[20], sites.x[21]);
  EXPECT_THAT(broken(), Contains("nearest"));
}

TEST_F(CheckGlobe, FindsWeightsThatWereLeftOut) {
  sites = capsOf(randomOnGlobe(200, 12), 0, 2e6, 1);
  Sites bare = sites;
  bare.weight.clear();
  cells = cellsOf(bare, ofGlobe());
  EXPECT_THAT(broken(), Contains("nearest"));
  cells = cellsOf(sites, ofGlobe());
  EXPECT_THAT(broken(), IsEmpty());
}

TEST_F(CheckGlobe, FindsArraysOfOtherLengths) {
  cells.solid_angle.pop_back();
  EXPECT_THAT(broken(), ElementsAre("arrays"));
}

}  // namespace
}  // namespace vorpipe::test
