#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "unit/fixtures/cpu_session.h"
#include "unit/fixtures/two_boxes.h"

namespace vorpipe {
namespace {

/// The promises that are broken, each by its name.
std::vector<std::string> brokenIn(const Diagram3& diagram, Detail3 detail = Detail3::polyhedra) {
  const auto lines = check(sitesOfTwoBoxes(), optionsOfTwoBoxes(detail), diagram);
  EXPECT_TRUE(lines.has_value());
  std::vector<std::string> names;
  for (const std::string& line : *lines) names.push_back(line.substr(0, line.find(':')));
  return names;
}

TEST(CheckInSpace, FindsNothingInRightCells) {
  EXPECT_EQ(brokenIn(twoBoxes()), std::vector<std::string>());
  EXPECT_EQ(brokenIn(twoBoxes(), Detail3::measures), std::vector<std::string>());
}

struct Fault {
  std::string name, promise;
  std::function<void(Diagram3&)> make;
};

class FaultInSpace : public testing::TestWithParam<Fault> {};

TEST_P(FaultInSpace, IsFound) {
  Diagram3 diagram = twoBoxes();
  GetParam().make(diagram);
  const auto broken = brokenIn(diagram);
  EXPECT_TRUE(std::ranges::find(broken, GetParam().promise) != broken.end())
      << testing::PrintToString(broken) << " without " << GetParam().promise;
}

/// Takes the other cell from the first one's neighbors.
void cutNeighbors(Diagram3& d) {
  d.neighbors[4] = wall_xmax;
  d.neighbors[5] = wall_xmin;
}

INSTANTIATE_TEST_SUITE_P(
    All, FaultInSpace,
    testing::Values(
        Fault{"Status", "statuses", [](Diagram3& d) { d.status[1] = Status::empty; }},
        Fault{"StatusOutOfRange", "statuses", [](Diagram3& d) { d.status[1] = static_cast<Status>(7); }},
        Fault{"Report", "statuses", [](Diagram3& d) { d.report.ok = 1; }},
        Fault{"Owner", "owners", [](Diagram3& d) { d.owner[1] = 0; }},
        Fault{"MissingRecord", "arrays", [](Diagram3& d) { d.volume.pop_back(); }},
        Fault{"Offsets", "arrays", [](Diagram3& d) { d.face_offsets[1] = 13; }},
        Fault{"RingOffsets", "arrays", [](Diagram3& d) { d.face_vertex_offsets.back() = 3; }},
        Fault{"VertexOutOfRange", "arrays", [](Diagram3& d) { d.face_vertices[0] = 12; }},
        Fault{"LabelOutOfRange", "arrays", [](Diagram3& d) { d.vertex_sites[0] = 2; }},
        Fault{"Volume", "volumes", [](Diagram3& d) { d.volume[0] *= 1 + 1e-11; }},
        Fault{"VolumesExchanged", "measures",
              [](Diagram3& d) {
                d.volume[0] += 0.01;
                d.volume[1] -= 0.01;
              }},
        Fault{"NotANumber", "neighbors",
              [](Diagram3& d) { d.volume[0] = std::numeric_limits<double>::quiet_NaN(); }},
        Fault{"Surface", "measures", [](Diagram3& d) { d.surface[0] = 4.1; }},
        Fault{"Area", "symmetry", [](Diagram3& d) { d.face_areas[5] = 1.01; }},
        Fault{"AreaInBothCells", "measures", [](Diagram3& d) { d.face_areas[5] = d.face_areas[11] = 1.01; }},
        Fault{"UnknownWall", "neighbors", [](Diagram3& d) { d.neighbors[0] = -8; }},
        Fault{"Outline", "neighbors", [](Diagram3& d) { d.neighbors[1] = wall_outline; }},
        Fault{"OwnNeighbor", "neighbors", [](Diagram3& d) { d.neighbors[5] = 0; }},
        Fault{"OneSided", "symmetry", cutNeighbors},
        Fault{"RingTurnsOtherWay", "symmetry",
              [](Diagram3& d) { std::reverse(d.face_vertices.begin() + 20, d.face_vertices.begin() + 24); }},
        Fault{"WallTurnsOtherWay", "polyhedra",
              [](Diagram3& d) { std::reverse(d.face_vertices.begin(), d.face_vertices.begin() + 4); }},
        Fault{"RingTwists", "polyhedra",
              [](Diagram3& d) { std::swap(d.face_vertices[0], d.face_vertices[1]); }},
        Fault{"VertexOffPlane", "vertices", [](Diagram3& d) { d.vertices[0].x += 1e-4; }},
        Fault{"VertexMovesInAllPlanes", "polyhedra",
              [](Diagram3& d) {
                for (std::size_t v = 4; v < 8; ++v) d.vertices[v].x += 1e-3;
              }},
        Fault{"LabelMissing", "polyhedra",
              [](Diagram3& d) {
                *std::ranges::find(d.vertex_sites, 1) = -1;  // of the first vertex in the middle
              }},
        Fault{"Centroid", "polyhedra", [](Diagram3& d) { d.centroid[0].y += 1e-3; }},
        Fault{"CentroidElsewhere", "nearest", [](Diagram3& d) { d.centroid[0].x = 0.6; }},
        Fault{"SecondMoment", "polyhedra", [](Diagram3& d) { d.second_moments[1][4] = 1e-3; }},
        Fault{"Flat", "polyhedra", [](Diagram3& d) { d.flat = 1; }},
        Fault{"SwappedCells", "nearest", [](Diagram3& d) { std::swap(d.centroid[0], d.centroid[1]); }}),
    [](const auto& fault) { return fault.param.name; });

TEST(CheckInSpace, KnowsDuplicatesAndSitesOutside) {
  Sites3 sites = sitesOfTwoBoxes();
  sites.push_back(sites[0]);
  sites.push_back({-2, 0.5, 0.5});
  Diagram3 d = twoBoxes();
  const auto add = [&](std::size_t i, Status status, std::uint32_t owner) {
    d.status.push_back(status);
    d.owner.push_back(owner);
    d.volume.push_back(0);
    d.surface.push_back(0);
    d.centroid.push_back(sites[i]);
    d.second_moments.push_back({});
    d.face_offsets.push_back(d.face_offsets.back());
  };
  add(2, Status::duplicate, 0);
  add(3, Status::empty, 3);
  d.report.duplicate = d.report.empty = 1;
  EXPECT_EQ(*check(sites, optionsOfTwoBoxes(), d), std::vector<std::string>());
  d.owner[2] = 1;
  EXPECT_FALSE(check(sites, optionsOfTwoBoxes(), d)->empty());
}

/// The tests change cells that repeat, and see which promises are broken then.
class CheckOfPeriods : public testing::Test {
 protected:
  void SetUp() override { compute(); }
  void compute() {
    cells = test::cpuSession(1).cells(std::span<const Point3>(sites), options).value();
    EXPECT_EQ(broken(), std::vector<std::string>());
  }
  [[nodiscard]] std::vector<std::string> broken() const {
    std::vector<std::string> names;
    const auto lines = check(sites, options, cells);
    for (const std::string& line : lines.value()) names.push_back(line.substr(0, line.find(':')));
    return names;
  }
  void expectBroken(const std::string& promise) {
    const auto names = broken();
    EXPECT_TRUE(std::ranges::find(names, promise) != names.end())
        << testing::PrintToString(names) << " without " << promise;
    compute();
  }
  /// A face with an image.
  [[nodiscard]] std::size_t moved() const {
    const auto found = std::ranges::find_if(
        cells.neighbor_shifts, [](const auto& shift) { return shift != std::array<std::int32_t, 3>{}; });
    return static_cast<std::size_t>(found - cells.neighbor_shifts.begin());
  }

  Sites3 sites = generate(Pattern3::random, 40, 12);
  Cells3Options options{{0, 0, 0, 1, 1, 1}, Detail3::polyhedra, {}, {}, {true, true, true}};
  Diagram3 cells;
};

TEST_F(CheckOfPeriods, FindsWrongShifts) {
  cells.neighbor_shifts.pop_back();
  expectBroken("arrays");
  cells.neighbor_shifts.clear();
  expectBroken("arrays");
  cells.neighbor_shifts[moved()][0] += 1;
  expectBroken("symmetry");
  for (auto& shift : cells.neighbor_shifts) shift = {-shift[0], -shift[1], -shift[2]};
  expectBroken("neighbors");
  // In both cells.
  const std::size_t face = moved();
  const auto i = static_cast<std::int64_t>(std::ranges::upper_bound(cells.face_offsets, face) -
                                           cells.face_offsets.begin() - 1);
  const auto j = static_cast<std::size_t>(cells.neighbors[face]);
  for (std::uint64_t f = cells.face_offsets[j]; f < cells.face_offsets[j + 1]; ++f) {
    if (cells.neighbors[f] == i) cells.neighbor_shifts[f][2] -= 1;
  }
  cells.neighbor_shifts[face][2] += 1;
  expectBroken("measures");
}

TEST_F(CheckOfPeriods, FindsWrongMeasuresAndPlaces) {
  cells.volume[3] *= 1 + 1e-9;
  expectBroken("volumes");
  cells.face_areas[moved()] *= 1.01;
  expectBroken("symmetry");
  std::swap(cells.centroid[0], cells.centroid[1]);
  expectBroken("nearest");
  // A whole period away, as if the site were there.
  cells.centroid[5].x += 1;
  expectBroken("nearest");
  for (std::uint64_t k = cells.face_vertex_offsets[moved()]; k < cells.face_vertex_offsets[moved() + 1]; ++k)
    cells.vertices[cells.face_vertices[k]].y += 1e-3;
  expectBroken("vertices");
}

TEST_F(CheckOfPeriods, FindsWallsWhereNoneAre) {
  cells.neighbors[cells.face_offsets[1]] = wall_xmin;
  expectBroken("neighbors");
  options.periodic = {false, true, true};
  compute();
  EXPECT_TRUE(std::ranges::find(cells.neighbors, std::int64_t{wall_xmin}) != cells.neighbors.end());
  const auto along_y = std::ranges::find_if(cells.neighbor_shifts, [](const auto& by) { return by[1] != 0; });
  (*along_y)[0] = 1;
  expectBroken("neighbors");
}

TEST_F(CheckOfPeriods, FindsDuplicatesThatAreNone) {
  sites[7] = {sites[3].x + 2, sites[3].y - 1, sites[3].z};
  for (double* each : {&sites[3].x, &sites[3].y, &sites[3].z}) *each = 0.25;
  sites[7] = {2.25, -0.75, 0.25};
  compute();
  EXPECT_EQ(cells.owner[7], 3U);
  cells.owner[7] = 4;
  expectBroken("owners");
  cells.owner[7] = 7;
  expectBroken("owners");
}

TEST_F(CheckOfPeriods, KnowsLattices) {
  options.periodic = {};
  options.lattice = Lattice{{1, 0, 0}, {7, 1, 0}, {0.25, -3, 1}};
  compute();
  options.lattice->c.z = 1.001;
  const auto names = broken();
  EXPECT_TRUE(std::ranges::find(names, "volumes") != names.end());
}

TEST(DiffInSpace, CountsWhatDiffers) {
  const Diagram3 a = twoBoxes();
  EXPECT_TRUE(diffCells(a, a)->agree());
  EXPECT_EQ(diffCells(a, a)->equal, 2u);
  Diagram3 b = a;
  b.volume[0] *= 1 + 1e-6;
  EXPECT_TRUE(diffCells(a, b)->agree());
  b.volume[0] = 0.51;
  b.neighbors[11] = wall_xmin;
  const auto diff = *diffCells(a, b);
  EXPECT_FALSE(diff.agree());
  EXPECT_EQ(diff.volumes, 1u);
  EXPECT_EQ(diff.neighbors, 1u);
  EXPECT_EQ(diff.statuses, 0u);
  EXPECT_EQ(diff.first, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_FALSE(diffCells(a, Diagram3{}).has_value());
}

}  // namespace
}  // namespace vorpipe
