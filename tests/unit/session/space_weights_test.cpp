// Power cells in space, from sites and weights to a diagram.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "unit/fixtures/cpu_session.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

constexpr Box3 weighed_cube{0, 0, 0, 1, 1, 1};
using Weights = std::vector<double>;

/// Checked by what shares no code with the run.
Diagram3 weighedCells(const Sites3& sites, const Weights& weights, const Box3& box = weighed_cube,
                      int threads = 1, Detail3 detail = Detail3::polyhedra) {
  auto session = test::cpuSession(threads);
  const Cells3Options options{box, detail, {}, weights};
  auto diagram = session.cells(std::span<const Point3>(sites), options);
  EXPECT_TRUE(diagram.has_value()) << (diagram ? "" : diagram.error().message);
  if (!diagram) return {};
  const auto problems = check(sites, options, *diagram, threads);
  EXPECT_TRUE(problems.has_value());
  for (const std::string& problem : *problems) ADD_FAILURE() << problem;
  const double volume = (box.xmax - box.xmin) * (box.ymax - box.ymin) * (box.zmax - box.zmin);
  EXPECT_NEAR(volumeSum(*diagram), volume, 1e-12 * volume);
  return std::move(*diagram);
}

std::set<std::int64_t> neighborsOf(const Diagram3& diagram, std::size_t i) {
  return {diagram.neighbors.begin() + static_cast<std::ptrdiff_t>(diagram.face_offsets[i]),
          diagram.neighbors.begin() + static_cast<std::ptrdiff_t>(diagram.face_offsets[i + 1])};
}

/// The same cells, number by number.
void expectSameBits(const Diagram3& a, const Diagram3& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.surface, b.surface);
  EXPECT_EQ(a.neighbors, b.neighbors);
  EXPECT_EQ(a.face_areas, b.face_areas);
  EXPECT_EQ(a.face_vertices, b.face_vertices);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.second_moments, b.second_moments);
}

double uniformDraw(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Weights drawn(std::size_t count, std::uint64_t seed, const std::function<double(double)>& of) {
  std::mt19937_64 random(seed);
  Weights weights(count);
  for (double& weight : weights) weight = of(uniformDraw(random));
  return weights;
}

/// Multiples of 2^-20: what is computed of them is exact.
double coarse(double number) { return std::round(number * 0x1p20) * 0x1p-20; }
Sites3 coarse(Sites3 sites) {
  for (Point3& p : sites) p = {coarse(p.x), coarse(p.y), coarse(p.z)};
  return sites;
}

double powerAt(const Sites3& sites, const Weights& weights, std::size_t i, const Point3& p) {
  const Point3& q = sites[i];
  return std::pow(p.x - q.x, 2) + std::pow(p.y - q.y, 2) + std::pow(p.z - q.z, 2) - weights[i];
}

TEST(WeighedSpace, CellsThatTheirSitesAreOutsideOfAreKept) {
  const Sites3 sites = generate(Pattern3::random, 1500, 3);
  const double spacing = std::cbrt(1.0 / 1500);
  // Radii that are up to ten times as large as the least.
  const Weights weights =
      drawn(sites.size(), 4, [&](double u) { return std::pow(0.2 * spacing * (1 + 9 * u * u * u), 2); });
  const Diagram3 diagram = weighedCells(sites, weights);
  std::size_t outside = 0, hidden = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    std::size_t least = 0;
    for (std::size_t j = 1; j < sites.size(); ++j) {
      if (powerAt(sites, weights, j, sites[i]) < powerAt(sites, weights, least, sites[i])) least = j;
    }
    if (diagram.status[i] == Status::ok) outside += least != i ? 1 : 0;
    if (diagram.status[i] != Status::empty) continue;
    ++hidden;
    EXPECT_NE(least, i);
    EXPECT_EQ(diagram.volume[i], 0);
    EXPECT_TRUE(neighborsOf(diagram, i).empty());
  }
  EXPECT_GT(outside, 50U);
  EXPECT_GT(hidden, 50U);
  EXPECT_EQ(diagram.report.hidden, hidden);
  EXPECT_EQ(diagram.report.empty, hidden);
  EXPECT_EQ(diagram.report.ok, sites.size() - hidden);
}

TEST(WeighedSpace, EqualWeightsAreNone) {
  for (const Pattern3 pattern : {Pattern3::random, Pattern3::fcc}) {
    const Sites3 sites = generate(pattern, 500, 1);
    const Diagram3 weighed = weighedCells(sites, Weights(sites.size(), 0.7));
    expectSameBits(weighed, weighedCells(sites, {}));
    EXPECT_EQ(weighed.report.hidden, 0U);
  }
}

TEST(WeighedSpace, AConstantChangesNothing) {
  for (const Pattern3 pattern : {Pattern3::random, Pattern3::bcc}) {
    const Sites3 sites = generate(pattern, 500, 1);
    Weights weights = drawn(sites.size(), 2, [](double u) { return coarse(0.02 * u); });
    const Diagram3 before = weighedCells(sites, weights);
    for (const double constant : {0.25, -3.0, 4096.0}) {
      Weights more = weights;
      for (double& weight : more) weight += constant;
      expectSameBits(before, weighedCells(sites, more));
    }
  }
}

TEST(WeighedSpace, NeitherThreadsNorTheOrderOfSitesCount) {
  const Sites3 sites = generate(Pattern3::clusters, 2000, 3);
  const Weights weights = drawn(sites.size(), 5, [](double u) { return 1e-3 * u * u; });
  const Diagram3 one = weighedCells(sites, weights);
  expectSameBits(one, weighedCells(sites, weights, weighed_cube, 2));
  std::vector<std::size_t> order(sites.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::shuffle(order, std::mt19937_64(5));
  Sites3 shuffled;
  Weights its_weights;
  for (const std::size_t i : order) {
    shuffled.push_back(sites[i]);
    its_weights.push_back(weights[i]);
  }
  const Diagram3 other = weighedCells(shuffled, its_weights);
  for (std::size_t k = 0; k < order.size(); ++k) {
    std::set<std::int64_t> theirs;
    for (const std::int64_t n : neighborsOf(other, k))
      theirs.insert(isWall(n) ? n : static_cast<std::int64_t>(order[static_cast<std::size_t>(n)]));
    EXPECT_EQ(neighborsOf(one, order[k]), theirs);
    EXPECT_EQ(one.status[order[k]], other.status[k]);
  }
}

/// Cells of sites that are moved by a symmetry of the cube; walls go to walls.
TEST(WeighedSpace, AxesAndMirrorsDoNotCount) {
  const auto moved = [](const Point3& p) { return Point3{1 - p.z, p.x, p.y}; };
  const auto movedWall = [](std::int64_t wall) -> std::int64_t {
    constexpr std::array<std::array<std::int64_t, 2>, 6> to{{{wall_xmin, wall_ymin},
                                                             {wall_xmax, wall_ymax},
                                                             {wall_ymin, wall_zmin},
                                                             {wall_ymax, wall_zmax},
                                                             {wall_zmin, wall_xmax},
                                                             {wall_zmax, wall_xmin}}};
    return (*std::ranges::find(to, wall, [](const auto& pair) { return pair[0]; }))[1];
  };
  // By few digits: of a lattice many cells meet in a point, whatever heights say.
  for (const Pattern3 pattern : {Pattern3::random, Pattern3::cubic, Pattern3::fcc}) {
    const Sites3 sites = coarse(generate(pattern, 700, 1));
    const Weights weights = drawn(sites.size(), 2, [](double u) { return std::floor(4 * u) / 512; });
    Sites3 other;
    for (const Point3& p : sites) other.push_back(moved(p));
    const Diagram3 a = weighedCells(sites, weights), b = weighedCells(other, weights);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      std::set<std::int64_t> expected;
      for (const std::int64_t n : neighborsOf(a, i)) expected.insert(isWall(n) ? movedWall(n) : n);
      EXPECT_EQ(expected, neighborsOf(b, i)) << i;
      EXPECT_EQ(a.status[i], b.status[i]);
      EXPECT_NEAR(a.volume[i], b.volume[i], 1e-14);
    }
  }
}

/// w = 2 a . x moves all cells as if sites were moved by -a.
TEST(WeighedSpace, AffineWeightsAreMovedSites) {
  const Point3 a{0.125, -0.0625, 0.03125};
  for (const Pattern3 pattern : {Pattern3::random, Pattern3::cubic, Pattern3::a15}) {
    const Sites3 sites = coarse(generate(pattern, 600, 1));
    Sites3 other;
    Weights weights;
    for (const Point3& p : sites) {
      other.push_back({p.x - a.x, p.y - a.y, p.z - a.z});
      weights.push_back(2 * (a.x * p.x + a.y * p.y + a.z * p.z));
    }
    const Diagram3 weighed = weighedCells(sites, weights), plain = weighedCells(other, {});
    EXPECT_EQ(weighed.status, plain.status);
    EXPECT_EQ(weighed.neighbors, plain.neighbors);
    for (std::size_t i = 0; i < sites.size(); ++i) EXPECT_NEAR(weighed.volume[i], plain.volume[i], 1e-14);
  }
}

TEST(WeighedSpace, OfManySizes) {
  const Sites3 sites = generate(Pattern3::random, 800, 7);
  const double square = std::pow(800, -2.0 / 3);
  const auto decades = [&](double u) { return square * std::pow(10, 6 * u - 5); };
  weighedCells(sites, drawn(sites.size(), 1, decades));
  weighedCells(sites, drawn(sites.size(), 1, [&](double u) { return -decades(u); }));
  weighedCells(sites, drawn(sites.size(), 2, [&](double u) { return square * (4 * u - 7); }));
  // A few are far heavier than all others, and reach over many.
  weighedCells(sites, drawn(sites.size(), 3, [&](double u) { return u < 0.005 ? 20 * u : square * u; }));
  // One hides all others, wherever it is.
  Weights one(sites.size(), 0);
  one[123] = 5;
  const Diagram3 alone = weighedCells(sites, one);
  EXPECT_EQ(alone.report.ok, 1U);
  EXPECT_EQ(alone.volume[123], 1);
  EXPECT_EQ(neighborsOf(alone, 123), (std::set<std::int64_t>{-7, -6, -4, -3, -2, -1}));
  Sites3 far = sites;
  far.push_back({40, 0.5, 0.5});
  one.push_back(40 * 40 + 10);
  EXPECT_EQ(weighedCells(far, one).report.ok, 1U);
}

/// Planes that are near come of weights and distances that are far: no digit of what is in the box is lost.
TEST(WeighedSpace, AFarSiteReachesIntoTheBox) {
  const Sites3 near = generate(Pattern3::random, 400, 7);
  const Weights weights = drawn(near.size(), 8, [](double u) { return 0.02 * u; });
  for (const double far : {10.0, 1e3, 1e6, 1e9}) {
    for (const Point3& place : {Point3{far, 0.5, 0.5}, {-far, 0.5, 0.5}, {0.3, 0.5, far}}) {
      Sites3 sites = near;
      Weights more = weights;
      sites.push_back(place);
      // To the middle of the box, but for what others weigh.
      more.push_back(std::pow(place.x - 0.5, 2) + std::pow(place.y - 0.5, 2) + std::pow(place.z - 0.5, 2));
      const Diagram3 diagram = weighedCells(sites, more);
      EXPECT_GT(diagram.volume.back(), 0.2);
      EXPECT_LT(diagram.volume.back(), 1);
    }
  }
}

TEST(WeighedSpace, OfHardSites) {
  std::mt19937_64 random(5);
  Sites3 line, plane, near, decimals;
  for (int k = 0; k < 100; ++k) {
    const double u = uniformDraw(random), v = uniformDraw(random), w = uniformDraw(random);
    line.push_back({u, 0.25, 0.5});
    plane.push_back({u, v, 0.5});
    near.push_back({u, v, w});
    near.push_back({u + 1e-9 * v, v, w - 1e-10 * u});
    decimals.push_back({std::round(10 * u) / 10, std::round(10 * v) / 10, std::round(10 * w) / 10});
  }
  for (const Sites3& sites : {line, plane, near, decimals, generate(Pattern3::sphere, 150, 2)}) {
    weighedCells(sites, drawn(sites.size(), 1, [](double u) { return 0.01 * u; }));
    weighedCells(sites, drawn(sites.size(), 2, [](double u) { return 0.01 * std::floor(3 * u); }));
  }
  // In crystals, so that cells are points, or needles.
  for (const Pattern3 pattern : {Pattern3::cubic, Pattern3::bcc, Pattern3::fcc, Pattern3::hcp}) {
    const Sites3 sites = generate(pattern, 216, 1);
    const double square = std::pow(static_cast<double>(sites.size()), -2.0 / 3);
    weighedCells(sites, drawn(sites.size(), 3, [&](double u) { return square * std::floor(3 * u) / 2; }));
    weighedCells(sites, drawn(sites.size(), 4, [&](double u) { return square * std::floor(8 * u) / 8; }));
  }
  weighedCells({{0.5, 0.5, 0.5}}, {3});
  weighedCells({{0.5, 0.5, 0.5}, {0.25, 0.5, 0.5}}, {3, 2.96875});
}

/// Between a site that weighs so much that its face with one neighbor passes through the middle of the other.
TEST(WeighedSpace, TwoSitesShareABoxAsTheyWeigh) {
  for (const double heavier : {0.0, 0.25, -0.25, 0.4, 0.75, -0.75}) {
    const Diagram3 diagram = weighedCells({{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}}, {heavier, 0});
    const double wall = 0.5 + heavier;  // (0.25 + heavier) / (2 * 0.5) from the first
    EXPECT_NEAR(diagram.volume[0], std::clamp(wall, 0.0, 1.0), 1e-15) << heavier;
    EXPECT_EQ(diagram.status[1], wall < 1 ? Status::ok : Status::empty);
    EXPECT_EQ(diagram.status[0], wall > 0 ? Status::ok : Status::empty);
  }
}

TEST(WeighedSpace, TheHeaviestOfEqualSitesOwnsTheCell) {
  const Sites3 sites{{0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}, {0.2, 0.2, 0.2}, {0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}};
  const Diagram3 diagram = weighedCells(sites, {0.1, 0.2, 0.3, 0.3, 0.2});
  EXPECT_EQ(diagram.owner, (std::vector<std::uint32_t>{2, 1, 2, 2, 1}));
  EXPECT_EQ(diagram.status, (std::vector<Status>{Status::duplicate, Status::ok, Status::ok, Status::duplicate,
                                                 Status::duplicate}));
  // Many in one place.
  Sites3 many(40, {0.5, 0.5, 0.5});
  Weights weights(40, 0.0);
  weights[17] = 1;
  EXPECT_EQ(weighedCells(many, weights).owner, std::vector<std::uint32_t>(40, 17));
}

/// In one layer cells are those of the plane, from floor to ceiling.
TEST(WeighedSpace, OneLayerIsThePlane) {
  for (const Pattern pattern : {Pattern::random, Pattern::hex}) {
    Sites flat = generate(pattern, 400, 1);
    flat.weight = drawn(flat.size(), 3, [](double u) { return 0.004 * u; });
    Sites3 sites;
    for (std::size_t i = 0; i < flat.size(); ++i) sites.push_back({flat.x[i], flat.y[i], 0.3});
    const Diagram3 space = weighedCells(sites, flat.weight);
    auto session = test::cpuSession();
    CellsOptions options;
    options.domain = {0, 0, 1, 1};
    const auto plane = session.cells(flat, options);
    ASSERT_TRUE(plane);
    std::size_t hidden = 0;
    for (std::size_t i = 0; i < flat.size(); ++i) {
      EXPECT_EQ(space.status[i], plane->status[i]);
      EXPECT_NEAR(space.volume[i], plane->area[i], 1e-15);
      hidden += space.status[i] == Status::empty ? 1U : 0U;
      if (space.status[i] != Status::ok) continue;
      std::set<std::int64_t> expected(
          plane->neighbors.begin() + static_cast<std::ptrdiff_t>(plane->cell_offsets[i]),
          plane->neighbors.begin() + static_cast<std::ptrdiff_t>(plane->cell_offsets[i + 1]));
      expected.insert({wall_zmin, wall_zmax});
      EXPECT_EQ(neighborsOf(space, i), expected);
    }
    EXPECT_GT(hidden, 10U);
  }
}

/// What is right for some weights is wrong for others, whoever is asked.
TEST(WeighedSpace, TheCheckKnowsWeights) {
  Sites3 sites = generate(Pattern3::random, 300, 5);
  sites.push_back(sites[7]);
  Weights weights = drawn(sites.size(), 6, [](double u) { return 0.01 * u; });
  weights[7] = weights.back() = 0.012;
  const Diagram3 diagram = weighedCells(sites, weights);
  const auto brokenBy = [&](const Diagram3& of, const Weights& other, Detail3 detail) {
    const auto lines = check(sites, {weighed_cube, detail, {}, other}, of);
    std::set<std::string> names;
    for (const std::string& line : *lines) names.insert(line.substr(0, line.find(':')));
    return names;
  };
  const auto whole = Detail3::polyhedra;
  EXPECT_EQ(brokenBy(diagram, weights, whole), std::set<std::string>());
  EXPECT_TRUE(brokenBy(diagram, {}, whole).contains("statuses"));
  Weights other = weights;
  other[3] += 1e-3;
  EXPECT_TRUE(brokenBy(diagram, other, whole).contains("vertices"));
  EXPECT_TRUE(brokenBy(diagram, other, Detail3::measures).contains("measures"));
  other = weights;
  other.back() += 1e-12;
  EXPECT_TRUE(brokenBy(diagram, other, whole).contains("owners"));
  // A hidden site that weighs enough for a cell of its own.
  const auto hidden =
      static_cast<std::size_t>(std::ranges::find(diagram.status, Status::empty) - diagram.status.begin());
  ASSERT_LT(hidden, sites.size());
  other = weights;
  other[hidden] += 0.02;
  EXPECT_TRUE(brokenBy(diagram, other, whole).contains("statuses"));
  EXPECT_TRUE(brokenBy(diagram, other, whole).contains("places"));
}

TEST(WeighedSpace, WrongWeightsAreRefused) {
  auto session = test::cpuSession();
  const Sites3 sites = generate(Pattern3::random, 3, 1);
  const auto refusal = [&](const Weights& weights) {
    const auto diagram =
        session.cells(std::span<const Point3>(sites), {weighed_cube, Detail3::measures, {}, weights});
    EXPECT_FALSE(diagram.has_value());
    if (diagram) return std::string();
    EXPECT_EQ(diagram.error().subject, Subject::weights);
    return diagram.error().message;
  };
  EXPECT_EQ(refusal({1, 2}), "there are 2 weights and 3 sites");
  EXPECT_EQ(refusal({1, 2, std::numeric_limits<double>::quiet_NaN()}),
            "the weight of site 2 is not finite: nan");
  EXPECT_EQ(refusal({1, -1e300, 2}), "the weight of site 1 is too large for the domain: -1e+300");
  const Weights large{1, 1e100, 0};
  EXPECT_TRUE(session.cells(std::span<const Point3>(sites), {weighed_cube, Detail3::measures, {}, large})
                  .has_value());
}

}  // namespace
}  // namespace vorpipe
