// Cells in space of sites that repeat, beside those of a box that holds all images nearby.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "unit/fixtures/cpu_session.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

using Shift3 = std::array<std::int32_t, 3>;

struct Repeating {
  std::string name;
  Box3 box{0, 0, 0, 1, 1, 1};
  std::array<bool, 3> periodic{};
  std::optional<vorpipe::Lattice> lattice{};
  /// Of a lattice that is not reduced: shorter vectors, as sums of its own.
  std::array<Shift3, 3> shorter{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  [[nodiscard]] bool along(std::size_t r) const { return lattice || periodic[r]; }
  [[nodiscard]] std::array<Point3, 3> vectors() const {
    if (lattice) return {lattice->a, lattice->b, lattice->c};
    return {{{box.xmax - box.xmin, 0, 0}, {0, box.ymax - box.ymin, 0}, {0, 0, box.zmax - box.zmin}}};
  }
  [[nodiscard]] Point3 moved(const Point3& p, const Shift3& by) const {
    Point3 to = p;
    for (std::size_t r = 0; r < 3; ++r) {
      const Point3 v = vectors()[r];
      to = {to.x + by[r] * v.x, to.y + by[r] * v.y, to.z + by[r] * v.z};
    }
    return to;
  }
  [[nodiscard]] double volume() const {
    const auto [a, b, c] = vectors();
    return std::abs(a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
                    a.z * (b.x * c.y - b.y * c.x));
  }
  [[nodiscard]] Cells3Options options(std::span<const double> weights = {}) const {
    return {box, Detail3::polyhedra, {}, weights, periodic, lattice};
  }
};

std::ostream& operator<<(std::ostream& to, const Repeating& of) { return to << of.name; }

const std::vector<Repeating>& allOfThem() {
  using L = vorpipe::Lattice;
  static const std::vector<Repeating> kinds = {
      {"xyz", {0, 0, 0, 1, 1, 1}, {true, true, true}},
      {"oblong", {-1, 2, 0.5, 1, 2.75, 3.5}, {true, true, true}},
      {"x", {0, 0, 0, 1, 1, 1}, {true, false, false}},
      {"yz", {0, -1, 0, 1, 0, 2}, {false, true, true}},
      {"hexagonal", {}, {}, L{{1, 0, 0}, {-0.5, std::sqrt(0.75), 0}, {0, 0, 1.25}}},
      {"fcc", {}, {}, L{{0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}}},
      {"triclinic", {}, {}, L{{1, 0, 0}, {0.3, 0.9, 0}, {-0.2, 0.4, 1.1}}},
      {"left-handed", {}, {}, L{{0, 1, 0.125}, {0.75, 0, 0}, {0, 0.25, 1}}},
      {"tilted",
       {},
       {},
       L{{1, 0, 0}, {100, 1, 0}, {37, -80, 1}},
       {{{1, 0, 0}, {-100, 1, 0}, {-8037, 80, 1}}}},
  };
  return kinds;
}

/// Checked by what shares no code with the run.
Diagram3 repeatingCells(const Sites3& sites, const Repeating& of, const std::vector<double>& weights = {},
                        int threads = 1) {
  auto session = test::cpuSession(threads);
  const Cells3Options options = of.options(weights);
  auto diagram = session.cells(std::span<const Point3>(sites), options);
  EXPECT_TRUE(diagram.has_value()) << (diagram ? "" : diagram.error().message);
  if (!diagram) return {};
  const auto problems = check(sites, options, *diagram, threads);
  EXPECT_TRUE(problems.has_value());
  for (const std::string& problem : *problems) ADD_FAILURE() << of.name << ": " << problem;
  EXPECT_NEAR(volumeSum(*diagram), of.volume(), 1e-12 * of.volume());
  return std::move(*diagram);
}

/// Neighbors of a cell: a site and by what it is moved, or a wall.
using Neighbor = std::pair<std::int64_t, Shift3>;
using Areas = std::map<Neighbor, double>;

Areas areasOf(const Diagram3& diagram, std::size_t i) {
  Areas areas;
  for (std::uint64_t f = diagram.face_offsets[i]; f < diagram.face_offsets[i + 1]; ++f)
    areas[{diagram.neighbors[f], diagram.neighbor_shifts[f]}] = diagram.face_areas[f];
  return areas;
}

struct Judged {
  Status status = Status::empty;
  double volume = 0;
  Point3 centroid{};
  Areas areas{};
};

/// The cells of all images of two periods around, in a box without periods; of each site that which is not
/// moved.
std::vector<Judged> amongImages(const Sites3& sites, const Repeating& of,
                                const std::vector<double>& weights) {
  std::vector<Shift3> shifts = {{}};
  const auto most = [&](std::size_t r) { return of.along(r) ? 2 : 0; };
  for (std::int32_t k = -most(0); k <= most(0); ++k) {
    for (std::int32_t l = -most(1); l <= most(1); ++l) {
      for (std::int32_t m = -most(2); m <= most(2); ++m) {
        Shift3 shift{};
        for (std::size_t a = 0; a < 3; ++a)
          shift[a] = k * of.shorter[0][a] + l * of.shorter[1][a] + m * of.shorter[2][a];
        if (shift != Shift3{}) shifts.push_back(shift);
      }
    }
  }
  Sites3 images;
  std::vector<double> all_weights;
  for (const Shift3& shift : shifts) {
    for (const Point3& p : sites) images.push_back(of.moved(p, shift));
    all_weights.insert(all_weights.end(), weights.begin(), weights.end());
  }
  const Box3 around = domainOf(images);
  Box3 box = of.box;
  if (of.along(0)) std::tie(box.xmin, box.xmax) = std::tuple(around.xmin, around.xmax);
  if (of.along(1)) std::tie(box.ymin, box.ymax) = std::tuple(around.ymin, around.ymax);
  if (of.along(2)) std::tie(box.zmin, box.zmax) = std::tuple(around.zmin, around.zmax);
  auto session = test::cpuSession(2);
  const auto diagram =
      session.cells(std::span<const Point3>(images), Cells3Options{box, Detail3::measures, {}, all_weights});
  EXPECT_TRUE(diagram.has_value()) << (diagram ? "" : diagram.error().message);
  std::vector<Judged> judged(sites.size());
  for (std::size_t i = 0; diagram && i < sites.size(); ++i) {
    judged[i] = {diagram->status[i], diagram->volume[i], diagram->centroid[i], {}};
    for (std::uint64_t f = diagram->face_offsets[i]; f < diagram->face_offsets[i + 1]; ++f) {
      const std::int64_t n = diagram->neighbors[f];
      const auto count = static_cast<std::int64_t>(sites.size());
      const Neighbor neighbor =
          n < 0 ? Neighbor{n, {}} : Neighbor{n % count, shifts[static_cast<std::size_t>(n / count)]};
      judged[i].areas[neighbor] = diagram->face_areas[f];
    }
  }
  return judged;
}

void expectJudged(const Diagram3& diagram, const Sites3& sites, const Repeating& of,
                  const std::vector<double>& weights = {}) {
  const auto judged = amongImages(sites, of, weights);
  const double mean = of.volume() / static_cast<double>(sites.size()), side = std::cbrt(mean);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    SCOPED_TRACE("site " + std::to_string(i));
    ASSERT_EQ(diagram.status[i], judged[i].status);
    EXPECT_NEAR(diagram.volume[i], judged[i].volume, 1e-10 * mean);
    EXPECT_NEAR(diagram.centroid[i].x, judged[i].centroid.x, 1e-9 * side);
    EXPECT_NEAR(diagram.centroid[i].y, judged[i].centroid.y, 1e-9 * side);
    EXPECT_NEAR(diagram.centroid[i].z, judged[i].centroid.z, 1e-9 * side);
    const Areas areas = areasOf(diagram, i);
    ASSERT_EQ(areas.size(), judged[i].areas.size());
    for (const auto& [neighbor, area] : judged[i].areas) {
      ASSERT_EQ(areas.count(neighbor), 1U) << neighbor.first << " moved by " << neighbor.second[0] << ", "
                                           << neighbor.second[1] << ", " << neighbor.second[2];
      EXPECT_NEAR(areas.at(neighbor), area, 1e-9 * side * side);
    }
  }
}

double drawnNumber(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Sites in one period.
Sites3 drawnSites(const Repeating& of, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Repeating shorter = of;
  Sites3 sites(count);
  for (Point3& p : sites) {
    p = of.lattice ? Point3{0, 0, 0} : Point3{of.box.xmin, of.box.ymin, of.box.zmin};
    for (std::size_t r = 0; r < 3; ++r) {
      const Point3 v = of.moved({0, 0, 0}, of.shorter[r]);
      const double part = drawnNumber(random);
      p = {p.x + part * v.x, p.y + part * v.y, p.z + part * v.z};
    }
  }
  return sites;
}

class SpacePeriods : public testing::TestWithParam<std::tuple<Repeating, std::size_t>> {};

TEST_P(SpacePeriods, HaveTheCellsOfAllTheirImages) {
  const auto& [of, count] = GetParam();
  const Sites3 sites = drawnSites(of, count, 5 + count);
  expectJudged(repeatingCells(sites, of), sites, of);
}

/// Some are hidden, and cells lie beside their sites.
TEST_P(SpacePeriods, HaveThePowerCellsOfAllTheirImages) {
  const auto& [of, count] = GetParam();
  const Sites3 sites = drawnSites(of, count, 50 + count);
  std::mt19937_64 random(count);
  const double spacing = std::cbrt(of.volume() / static_cast<double>(count));
  std::vector<double> weights(count);
  for (double& weight : weights) weight = std::pow(0.9 * spacing * drawnNumber(random), 2);
  weights.back() = std::pow(1.2 * spacing, 2);
  const Diagram3 diagram = repeatingCells(sites, of, weights);
  expectJudged(diagram, sites, of, weights);
  if (count > 20) {
    EXPECT_GT(diagram.report.hidden, 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SpacePeriods,
                         testing::Combine(testing::ValuesIn(allOfThem()),
                                          testing::Values<std::size_t>(1, 2, 3, 4, 7, 20, 60)),
                         [](const auto& of) {
                           std::string name = std::get<0>(of.param).name;
                           std::erase(name, '-');
                           return name + "With" + std::to_string(std::get<1>(of.param));
                         });

/// Faces of the one cell of a lattice's period.
std::size_t facesOfOne(const vorpipe::Lattice& lattice) {
  const Diagram3 diagram = repeatingCells({{0.3, -0.2, 11.7}}, {"one", {}, {}, lattice});
  return diagram.neighbors.size();
}

TEST(SpacePeriod, OneSiteHasTheCellOfItsLattice) {
  const Diagram3 cube = repeatingCells({{0.5, 0.25, 3}}, allOfThem()[0]);
  EXPECT_EQ(areasOf(cube, 0), (Areas{{{0, {1, 0, 0}}, 1.0},
                                     {{0, {-1, 0, 0}}, 1.0},
                                     {{0, {0, 1, 0}}, 1.0},
                                     {{0, {0, -1, 0}}, 1.0},
                                     {{0, {0, 0, 1}}, 1.0},
                                     {{0, {0, 0, -1}}, 1.0}}));
  EXPECT_EQ(cube.centroid[0], (Point3{0.5, 0.25, 3}));
  EXPECT_EQ(facesOfOne({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 6U);
  EXPECT_EQ(facesOfOne({{-0.5, 0.5, 0.5}, {0.5, -0.5, 0.5}, {0.5, 0.5, -0.5}}), 14U);
  EXPECT_EQ(facesOfOne({{0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}}), 12U);
  EXPECT_EQ(facesOfOne({{1, 0, 0}, {0.5, std::sqrt(0.75), 0}, {0, 0, 1}}), 8U);
  // The cube's lattice, by other vectors.
  EXPECT_EQ(facesOfOne({{1, 0, 0}, {100, 1, 0}, {-7, 100, 1}}), 6U);
  EXPECT_EQ(facesOfOne({{1000, 1, 0}, {999, 1, 0}, {0, 3000, 1}}), 6U);
  // And long ones.
  EXPECT_EQ(facesOfOne({{1, 0, 0}, {0, 1, 0}, {0, 0, 30}}), 6U);
}

TEST(SpacePeriod, OneOfSeveralVectorsNamesTheImage) {
  const Repeating tilted{"", {}, {}, vorpipe::Lattice{{1, 0, 0}, {100, 1, 0}, {0, 0, 1}}};
  const Areas areas = areasOf(repeatingCells({{0.5, 0.5, 0.5}}, tilted), 0);
  ASSERT_EQ(areas.size(), 6U);
  EXPECT_NEAR(areas.at({0, {-100, 1, 0}}), 1, 1e-12);
  EXPECT_NEAR(areas.at({0, {100, -1, 0}}), 1, 1e-12);
}

TEST(SpacePeriod, LatticesOfWholeCellsHaveNoBorder) {
  const Repeating& cube = allOfThem()[0];
  const std::tuple<Pattern3, std::size_t, std::size_t> crystals[] = {{Pattern3::cubic, 6, 6},
                                                                     {Pattern3::bcc, 14, 14},
                                                                     {Pattern3::fcc, 12, 12},
                                                                     {Pattern3::diamond, 16, 16},
                                                                     {Pattern3::a15, 12, 14}};
  for (const auto& [pattern, least, most] : crystals) {
    const Sites3 sites = generate(pattern, 500, 1);
    const Diagram3 diagram = repeatingCells(sites, cube);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const std::size_t faces = diagram.face_offsets[i + 1] - diagram.face_offsets[i];
      EXPECT_TRUE(faces == least || faces == most) << faces;
    }
  }
}

/// Where ties end, both copies of a cell must have the same ones.
TEST(SpacePeriod, TiesAreTheSameAtTheBorder) {
  for (const Pattern3 pattern : {Pattern3::cubic, Pattern3::fcc, Pattern3::diamond}) {
    for (const double noise : {1e-15, 1e-12, 1e-9, 1e-7, 3e-7, 1e-6, 3e-6, 1e-5, 1e-4}) {
      Sites3 sites = generate(pattern, 216, 1);
      std::mt19937_64 random(3);
      const double most = noise * std::cbrt(1.0 / static_cast<double>(sites.size()));
      const auto draw = [&] { return most * (2 * drawnNumber(random) - 1); };
      for (Point3& p : sites) p = {p.x + draw(), p.y + draw(), p.z + draw()};
      SCOPED_TRACE(testing::Message() << static_cast<int>(pattern) << " " << noise);
      repeatingCells(sites, allOfThem()[0]);
    }
  }
}

TEST(SpacePeriod, SitesThatAreOneInThePeriodAreDuplicates) {
  const Sites3 sites = {{0, 0.5, 0.5}, {1, 0.5, 0.5}, {0.25, 0.25, 0.25}, {-2.75, 7.25, 1.25}, {3, -0.5, 9.5},
                        {0.5, 0, 1},   {0.5, 1, 0},   {1, 1, 1},          {0, 0, 0},           {0, 1, 0}};
  const Diagram3 diagram = repeatingCells(sites, allOfThem()[0]);
  EXPECT_EQ(diagram.owner, (std::vector<std::uint32_t>{0, 0, 2, 2, 0, 5, 5, 7, 7, 7}));
  EXPECT_EQ(diagram.report.duplicate, 6U);
  // The heaviest of them has the cell.
  const std::vector<double> weights = {0, 0, 0.01, 0.02, 0.01, 0, 0, 0, 0, 0};
  EXPECT_EQ(repeatingCells(sites, allOfThem()[0], weights).owner,
            (std::vector<std::uint32_t>{4, 4, 3, 3, 4, 5, 5, 7, 7, 7}));
  // Without a period along y and z.
  const Sites3 at_ends = {{0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0.5, 0.5, 0.5}};
  EXPECT_EQ(repeatingCells(at_ends, allOfThem()[2]).owner, (std::vector<std::uint32_t>{0, 0, 2, 3}));
}

/// Sites are whole multiples of 2^-20, so that nothing is rounded.
TEST(SpacePeriod, SitesManyPeriodsAwayHaveTheSameCells) {
  for (const std::size_t which : {0U, 2U, 7U}) {
    const Repeating& of = allOfThem()[which];
    Sites3 sites = drawnSites(of, 40, 9);
    for (Point3& p : sites) {
      for (double* each : {&p.x, &p.y, &p.z}) *each = std::round(*each * 0x1p20) * 0x1p-20;
    }
    const Diagram3 before = repeatingCells(sites, of);
    Sites3 away = sites;
    std::vector<Shift3> home(sites.size());
    std::mt19937_64 random(4);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      for (std::size_t r = 0; r < 3; ++r)
        home[i][r] = of.along(r) ? static_cast<std::int32_t>(random() % 2000) - 1000 : 0;
      away[i] = of.moved(sites[i], home[i]);
    }
    const Diagram3 after = repeatingCells(away, of);
    EXPECT_EQ(after.volume, before.volume);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      Areas moved;
      for (const auto& [named, area] : areasOf(before, i)) {
        auto [j, shift] = named;
        for (std::size_t r = 0; j >= 0 && r < 3; ++r)
          shift[r] += home[i][r] - home[static_cast<std::size_t>(j)][r];
        moved[{j, shift}] = area;
      }
      EXPECT_EQ(areasOf(after, i), moved);
      const Point3 centroid = of.moved(before.centroid[i], home[i]);
      EXPECT_NEAR(after.centroid[i].x, centroid.x, 1e-11);
      EXPECT_NEAR(after.centroid[i].y, centroid.y, 1e-11);
      EXPECT_NEAR(after.centroid[i].z, centroid.z, 1e-11);
    }
  }
}

TEST(SpacePeriod, TheOrderOfSitesChangesNothing) {
  const Repeating& of = allOfThem()[6];
  const Sites3 sites = drawnSites(of, 200, 17);
  const Diagram3 before = repeatingCells(sites, of);
  std::vector<std::size_t> order(sites.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(2));
  Sites3 shuffled;
  for (const std::size_t i : order) shuffled.push_back(sites[i]);
  const Diagram3 after = repeatingCells(shuffled, of, {}, 3);
  for (std::size_t k = 0; k < order.size(); ++k) {
    EXPECT_NEAR(after.volume[k], before.volume[order[k]], 1e-15);
    const Areas expected = areasOf(before, order[k]);
    EXPECT_EQ(areasOf(after, k).size(), expected.size());
    for (const auto& [neighbor, area] : areasOf(after, k)) {
      const auto was = static_cast<std::int64_t>(order[static_cast<std::size_t>(neighbor.first)]);
      ASSERT_EQ(expected.count({was, neighbor.second}), 1U);
      EXPECT_NEAR(area, expected.at({was, neighbor.second}), 1e-14);
    }
  }
}

/// It is heavier by squares of many periods: no wider band than a period is needed.
TEST(SpacePeriod, AHeavySiteHidesAllOthers) {
  for (const Repeating& of : allOfThem()) {
    const Sites3 sites = drawnSites(of, 30, 21);
    std::vector<double> weights(sites.size(), 0);
    weights[11] = 1e6;
    const Diagram3 diagram = repeatingCells(sites, of, weights);
    EXPECT_EQ(diagram.report.ok, 1U);
    EXPECT_EQ(diagram.report.hidden, 29U);
    EXPECT_NEAR(diagram.volume[11], of.volume(), 1e-12 * of.volume());
  }
}

/// Meijering 1953, Gilbert 1962.
TEST(SpacePeriod, WhiteNoiseHasItsConstants) {
  constexpr std::size_t n = 20'000;
  const Sites3 sites = generate(Pattern3::random, n, 8);
  const Diagram3 diagram = repeatingCells(sites, allOfThem()[0], {}, 2);
  double faces = 0, faces_squared = 0, vertices = 0, second = 0, fourth = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint64_t begin = diagram.face_offsets[i], end = diagram.face_offsets[i + 1];
    const auto count = static_cast<double>(end - begin);
    faces += count / n;
    faces_squared += count * count / n;
    // Each vertex is in three faces.
    vertices +=
        static_cast<double>(diagram.face_vertex_offsets[end] - diagram.face_vertex_offsets[begin]) / 3 / n;
    const double off = std::pow(diagram.volume[i] * n - 1, 2);
    second += off / n;
    fourth += off * off / n;
  }
  const double error = std::sqrt((faces_squared - faces * faces) / n);
  EXPECT_LT(error, 0.03);
  EXPECT_NEAR(faces, 15.5355, 3 * error);
  EXPECT_NEAR(vertices, 27.0709, 6 * error);
  const double variance_error = std::sqrt((fourth - second * second) / n);
  EXPECT_LT(variance_error, 0.004);
  EXPECT_NEAR(second, 0.1790, 3 * variance_error);
}

std::string refusedPeriod(const Repeating& of, const Sites3& sites = {{0.5, 0.5, 0.5}}) {
  const auto diagram = test::cpuSession().cells(std::span<const Point3>(sites), of.options());
  return diagram ? "" : diagram.error().message;
}

TEST(SpacePeriod, WhatIsNoPeriodIsRefused) {
  const auto ofLattice = [](const vorpipe::Lattice& lattice) { return refusedPeriod({"", {}, {}, lattice}); };
  EXPECT_EQ(ofLattice({{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}),
            "the lattice 1,0,0,0,1,0,1,1,0 has vectors that lie in a plane, or nearly so");
  EXPECT_EQ(ofLattice({{1, 0, 0}, {0, NAN, 0}, {1, 1, 0}}),
            "the lattice 1,0,0,0,nan,0,1,1,0 has numbers that are not finite");
  EXPECT_NE(ofLattice({{1e-120, 0, 0}, {0, 1e-120, 0}, {0, 0, 1e-120}}).find("its volume must lie between"),
            std::string::npos);
  EXPECT_EQ(refusedPeriod(allOfThem()[0], {{1e12, 0, 0}}),
            "site 0 is too many periods away: 1000000000000, 0, 0");
  // Columns so thin that a cell has more neighbors than can be held.
  EXPECT_NE(ofLattice({{1e-5, 0, 0}, {0, 1e-5, 0}, {0, 0, 1}}).find("images of its sites"),
            std::string::npos);
}

TEST(SpacePeriod, DomainsFarFromTheOriginRepeat) {
  const Repeating far{"far", {1e12, 0, -1e12, 1e12 + 1, 1, -1e12 + 1}, {true, true, true}};
  const Sites3 sites = {{1e12 + 0.25, 0.5, -1e12 + 0.5}, {1e12 + 0.75, 0.25, -1e12 + 0.125}};
  EXPECT_EQ(repeatingCells(sites, far).report.ok, 2U);
}

}  // namespace
}  // namespace vorpipe
