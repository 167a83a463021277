/// Sites that relax on the globe.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <random>

#include "globe/direction.h"
#include "globe/sphere_mesh.h"
#include "globe/sphere_moments.h"
#include "unit/fixtures/cpu_session.h"
#include "vorpipe.h"
#include "vorpipe/stipple.h"

namespace vorpipe::test {
namespace {

using core::Direction;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double pi = std::numbers::pi;

RelaxOptions onGlobe(RelaxMethod method, std::uint64_t iterations) {
  RelaxOptions options{};
  options.globe = true;
  options.method = method;
  options.iterations = iterations;
  return options;
}

Sites randomPlaces(std::uint64_t count, std::uint64_t seed) {
  return spreadOverGlobe(generate(Pattern::random, count, seed));
}

Relaxed relaxedOnGlobe(const Sites& sites, const RelaxOptions& options) {
  Session session = cpuSession();
  auto done = relax(session, sites, options);
  EXPECT_TRUE(done) << (done ? "" : done.error().message);
  return done ? std::move(*done) : Relaxed{};
}

/// Twice as dense in the east as in the west, smooth in between.
Density smoothDensity() {
  Density density{360, 180, {}};
  for (int row = 0; row < density.height; ++row) {
    for (int column = 0; column < density.width; ++column) {
      const double longitude = (column + 0.5) * pi / 180, latitude = (89.5 - row) * pi / 180;
      density.values.push_back(2 + std::cos(latitude) * std::sin(longitude));
    }
  }
  return density;
}

double energyOnGlobe(const Sites& sites, const RelaxOptions& options) {
  return relaxedOnGlobe(sites, options).trace.front().energy;
}

/// Number of cells by their number of neighbors, up to 15.
std::array<int, 16> neighborCounts(const Sites& sites) {
  Session session = cpuSession();
  CellsOptions cells{};
  cells.globe = true;
  cells.detail = Detail::measures;
  const Diagram diagram = session.cells(sites, cells).value();
  std::array<int, 16> counts{};
  for (const Cell cell : diagram) ++counts.at(std::min<std::size_t>(cell.neighbors().size(), 15));
  return counts;
}

Direction directionAt(const Sites& sites, std::size_t i) {
  return core::directionOf({sites.x[i], sites.y[i]});
}

TEST(GlobeRelaxation, MomentsAddUpToTheSphere) {
  for (const std::uint64_t count : {1U, 2U, 3U, 4U, 50U, 3000U}) {
    const core::SphereSites sites = core::placedOn(randomPlaces(count, 5), 1);
    const auto mesh = core::triangulateSphere(sites, 1).value();
    const auto cells = core::cellsOfSphere(sites, mesh, false, 1).value();
    double area = 0;
    Direction moment{0, 0, 0};
    cells.visit(0, cells.steps(), [&](const core::SphereCell& cell) {
      const auto of_cell = core::momentsOf(sites, cell, nullptr);
      area += of_cell.area;
      moment = moment + of_cell.mass * cell.direction + of_cell.lean;
      // |x - p|^2 = 2 - 2 x . p.
      EXPECT_NEAR(of_cell.energy, -2 * dot(of_cell.lean, cell.direction), 1e-11 * of_cell.energy);
    });
    EXPECT_NEAR(area, 4 * pi, 1e-12) << count;
    EXPECT_LT(lengthOf(moment), 1e-12) << count;
  }
}

TEST(GlobeRelaxation, TheLeastEnergyIsThatOfTheOctahedronAndTheIcosahedron) {
  const Sites octahedron{{0, 90, 180, -90, 0, 0}, {0, 0, 0, 0, 90, -90}, {}};
  const Sites icosahedron = generateOnGlobe(GlobePattern::icosahedral, 12).value();
  for (const auto* sites : {&octahedron, &icosahedron}) {
    for (const RelaxMethod method : {RelaxMethod::lloyd, RelaxMethod::lbfgs}) {
      const Relaxed done = relaxedOnGlobe(*sites, onGlobe(method, 20));
      for (const RelaxStep& step : done.trace) EXPECT_NEAR(step.hexagonal, 1, 1e-11);
      for (std::size_t i = 0; i < sites->size(); ++i) {
        EXPECT_LT(lengthOf(directionAt(done.sites, i) - directionAt(*sites, i)), 1e-12) << "site " << i;
      }
    }
  }
  // Many cells have that of hexagons in the plane.
  const double count = 1e6, hexagons = 5 / (18 * std::sqrt(3.0)) * 16 * pi * pi / count;
  EXPECT_NEAR(core::leastEnergyOnSphere(1000000) / hexagons, 1, 1e-5);
  EXPECT_NEAR(core::leastEnergyOnSphere(2), energyOnGlobe({{0, 180}, {0, 0}, {}}, onGlobe({}, 0)), 1e-11);
  EXPECT_NEAR(core::leastEnergyOnSphere(1), energyOnGlobe({{7}, {7}, {}}, onGlobe({}, 0)), 1e-11);
}

/// The gradient is -2 lean / cos(r) across the site; differences of the energy in degrees along its meridian.
void expectGlobeGradient(const Sites& sites, const RelaxOptions& options, double slack) {
  const core::SphereSites placed = core::placedOn(sites, 1);
  const auto mesh = core::triangulateSphere(placed, 1).value();
  const auto cells = core::cellsOfSphere(placed, mesh, false, 1).value();
  std::optional<core::GlobeDensity> density;
  if (!options.density.values.empty()) density.emplace(options.density);
  constexpr double step = 1e-2, degree = pi / 180;
  cells.visit(0, cells.steps(), [&](const core::SphereCell& cell) {
    const auto i = cell.site;
    if (i % 7 != 0) return;
    Sites north = sites, south = sites;
    north.y[i] += step;
    south.y[i] -= step;
    const Direction up = 1 / (2 * step * degree) * (directionAt(north, i) - directionAt(south, i));
    const double slope =
        (energyOnGlobe(north, options) - energyOnGlobe(south, options)) / (2 * step * degree);
    const auto of_cell = core::momentsOf(placed, cell, density ? &*density : nullptr);
    EXPECT_NEAR(slope, -2 * (1 + placed.excessOf(i)) * dot(of_cell.lean, up), slack) << "site " << i;
  });
}

TEST(GlobeRelaxation, TheGradientIsThatOfTheEnergy) {
  Sites sites = randomPlaces(60, 3);
  RelaxOptions options = onGlobe(RelaxMethod::lbfgs, 0);
  expectGlobeGradient(sites, options, 1e-7);
  for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(1e4 * static_cast<double>(i % 5));
  expectGlobeGradient(sites, options, 1e-7);
  options.density = smoothDensity();
  expectGlobeGradient(sites, options, 1e-5);
}

TEST(GlobeRelaxation, EnergyFallsAtEveryStepOfLloyds) {
  Sites sites = randomPlaces(500, 1);
  RelaxOptions options = onGlobe(RelaxMethod::lloyd, 30);
  const auto expectFall = [&] {
    const Relaxed done = relaxedOnGlobe(sites, options);
    ASSERT_EQ(done.trace.size(), options.iterations + 1);
    for (std::size_t k = 1; k < done.trace.size(); ++k) {
      EXPECT_LT(done.trace[k].energy, done.trace[k - 1].energy) << "diagram " << k;
    }
  };
  expectFall();
  options.iterations = 8;
  options.density = smoothDensity();
  expectFall();
  for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(1e3 * static_cast<double>(i % 5));
  expectFall();
}

TEST(GlobeRelaxation, AGeodesicGridHasTwelvePentagonsAndHexagons) {
  const Sites grid = generateOnGlobe(GlobePattern::icosahedral, 2562).value();
  ASSERT_EQ(grid.size(), 2562u);
  const Relaxed done = relaxedOnGlobe(grid, onGlobe(RelaxMethod::lbfgs, 30));
  for (const Sites* sites : {&grid, &done.sites}) {
    const auto counts = neighborCounts(*sites);
    EXPECT_EQ(counts[5], 12);
    EXPECT_EQ(counts[6], 2550);
  }
  EXPECT_LT(done.trace.back().hexagonal, 1.0055);
  EXPECT_GE(done.trace.back().hexagonal, 1);
  EXPECT_GE(neighborCounts(relaxedOnGlobe(randomPlaces(2562, 1), onGlobe(RelaxMethod::lloyd, 100)).sites)[6],
            0.75 * 2562);
  const Relaxed fast = relaxedOnGlobe(randomPlaces(2562, 1), onGlobe(RelaxMethod::lbfgs, 100));
  EXPECT_GE(neighborCounts(fast.sites)[6], 0.82 * 2562);
  EXPECT_LT(fast.trace.back().hexagonal, 1.012);
}

TEST(GlobeRelaxation, GridsOfAnyPartsAreWhole) {
  for (const std::uint64_t parts : {1U, 2U, 3U, 6U, 7U, 12U}) {
    const std::uint64_t count = 10 * parts * parts + 2;
    const Sites grid = generateOnGlobe(GlobePattern::icosahedral, count).value();
    const auto counts = neighborCounts(grid);
    EXPECT_EQ(grid.size(), count);
    EXPECT_EQ(counts[5], 12) << count;
    EXPECT_EQ(counts[6], static_cast<int>(count) - 12) << count;
  }
  for (const auto& [count, numbers] :
       {std::pair(100U, "92 and 162"), {11U, "12 and 42"}, {643U, "642 and 812"}}) {
    EXPECT_THAT(generateOnGlobe(GlobePattern::icosahedral, count).error().message, HasSubstr(numbers));
  }
  const Sites spiral = generateOnGlobe(GlobePattern::fibonacci, 1000).value();
  EXPECT_LT(energyOnGlobe(spiral, onGlobe({}, 0)), 1.05 * core::leastEnergyOnSphere(1000));
}

TEST(GlobeRelaxation, TurnsAboutTheAxisWithItsSites) {
  const Sites sites = randomPlaces(300, 4);
  Sites turned = sites;
  constexpr double turn = 137.25;
  for (double& x : turned.x) x += turn;
  const Relaxed a = relaxedOnGlobe(sites, onGlobe(RelaxMethod::lbfgs, 12));
  const Relaxed b = relaxedOnGlobe(turned, onGlobe(RelaxMethod::lbfgs, 12));
  EXPECT_NEAR(a.trace.back().energy, b.trace.back().energy, 1e-10 * a.trace.back().energy);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Direction there = core::directionOf({a.sites.x[i] + turn, a.sites.y[i]});
    EXPECT_LT(lengthOf(directionAt(b.sites, i) - there), 1e-8) << "site " << i;
  }
}

/// Spacing follows density^(-1/4): sixteen times as dense halves it, so that there are four times as many
/// sites.
TEST(GlobeRelaxation, ADensityHalvesTheSpacingWhereItIsSixteenTimes) {
  constexpr std::uint64_t count = 1000;
  const std::uint64_t seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  RelaxOptions options = onGlobe(RelaxMethod::lbfgs, 40);
  Density& density = options.density;
  density = {72, 36, std::vector<double>(std::size_t{72} * 36, 1)};
  for (std::size_t k = 0; k < density.values.size(); ++k) {
    if (k % 72 < 36) density.values[k] = 16;  // the western hemisphere
  }
  const auto westOf = [](const Sites& of) {
    return static_cast<double>(std::ranges::count_if(of.x, [](double x) { return x < 0; }));
  };
  EXPECT_NEAR(westOf(drawnOnGlobe(density, count, seed).value()), count * 16.0 / 17, 3);
  // A few diagrams do not carry sites far, so that it begins with as many as there are at the end.
  Sites sites = randomPlaces(count, seed);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double longitude = std::abs(sites.x[i]);
    sites.x[i] = i % 5 == 0 ? longitude : -longitude;
  }
  const Relaxed done = relaxedOnGlobe(sites, options);
  EXPECT_NEAR(westOf(done.sites), 0.8 * count, 0.04 * count);
  EXPECT_LT(done.trace.back().hexagonal, 1.06);
  // Spacings well inside of each half, by the number of sites within 60 degrees of its middle.
  const auto nearOf = [&](double longitude) {
    double near = 0;
    for (std::size_t i = 0; i < count; ++i) {
      near += dot(directionAt(done.sites, i), core::directionOf({longitude, 0})) > 0.5 ? 1 : 0;
    }
    return near;
  };
  EXPECT_NEAR(std::sqrt(nearOf(-90) / nearOf(90)), 2, 0.2);
}

TEST(GlobeRelaxation, AGridOfPixelsDoesNotShow) {
  // The same density by 2:1 pixels of one size and of half of it, and from 0 to 360 degrees.
  RelaxOptions options = onGlobe(RelaxMethod::lbfgs, 0);
  const Sites sites = randomPlaces(200, 2);
  options.density = smoothDensity();
  const double energy = energyOnGlobe(sites, options);
  Density turned = options.density;
  for (std::size_t row = 0; row < 180; ++row) {
    const auto begin = turned.values.begin() + static_cast<std::ptrdiff_t>(360 * row);
    std::rotate(begin, begin + 180, begin + 360);
  }
  turned.box = Box{0, -90, 360, 90};
  // The sine of the longitude from the west side is minus that from Greenwich.
  options.density = turned;
  EXPECT_NEAR(energyOnGlobe(sites, options), energy, 1e-12 * energy);
  // Of one pixel, any density is even.
  options.density = {1, 1, {3}};
  RelaxOptions even = onGlobe(RelaxMethod::lbfgs, 0);
  EXPECT_NEAR(energyOnGlobe(sites, options), 3 * energyOnGlobe(sites, even), 1e-11 * energy);
}

TEST(GlobeRelaxation, SitesThatOwnNothingGetPlaces) {
  Sites sites = randomPlaces(50, 1);
  for (int k = 0; k < 3; ++k) {
    sites.x.push_back(sites.x[0]);
    sites.y.push_back(sites.y[0]);
  }
  RelaxOptions options = onGlobe(RelaxMethod::lloyd, 6);
  const Relaxed done = relaxedOnGlobe(sites, options);
  EXPECT_THAT(done.report.notes, ElementsAre("3 sites at the place of another: set beside it"));
  EXPECT_EQ(done.report.ok, sites.size());
  options.density = {2, 1, {1, 0}};
  options.density.box = Box{-180, -90, 0, 90};
  const Relaxed west = relaxedOnGlobe(sites, options);
  EXPECT_EQ(west.report.notes.size(), 2u);
  EXPECT_LT(*std::ranges::max_element(west.sites.x), 0);
}

TEST(GlobeRelaxation, ThreadsChangeNothing) {
  const Sites sites = randomPlaces(3000, 2);
  const auto with = [&](int threads) {
    BackendOptions backend;
    backend.name = "cpu";
    backend.threads = threads;
    Session session = Session::open(backend).value();
    return relax(session, sites, onGlobe(RelaxMethod::lbfgs, 5)).value().sites;
  };
  const Sites one = with(1), two = with(2);
  EXPECT_EQ(one.x, two.x);
  EXPECT_EQ(one.y, two.y);
}

TEST(GlobeRelaxation, Refuses) {
  Session session = cpuSession();
  const Sites sites = randomPlaces(5, 1);
  RelaxOptions options = onGlobe(RelaxMethod::lbfgs, 1);
  const auto refusal = [&] { return relax(session, sites, options).error(); };
  options.density = {1, 1, {0}};
  EXPECT_EQ(refusal().subject, Subject::density);
  options.density = {1, 1, {1}};
  options.density.box = Box{0, 0, 361, 10};
  EXPECT_THAT(refusal().message, HasSubstr("not on the globe"));
  options.density.box = Box{0, 0, 10, 91};
  EXPECT_THAT(refusal().message, HasSubstr("not on the globe"));
  options.density = {};
  options.equal_masses = true;
  EXPECT_EQ(refusal().code, ErrorCode::input);
  options.equal_masses = false;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(refusal().code, ErrorCode::cancelled);
  EXPECT_EQ(relax(session, {{0}, {95}, {}}, onGlobe({}, 1)).error().subject, Subject::sites);
}

}  // namespace
}  // namespace vorpipe::test
