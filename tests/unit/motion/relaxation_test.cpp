#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motion/movable.h"
#include "motion/quasi_newton.h"
#include "support/devices/backends.h"
#include "unit/motion/blob.h"
#include "vorpipe.h"
#include "vorpipe/stipple.h"

namespace vorpipe::test {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

Session sessionOf(const std::string& backend = "cpu", int threads = 0) {
  BackendOptions options;
  options.name = backend;
  options.threads = threads;
  return std::move(Session::open(options).value());
}

RelaxOptions relaxOptions(RelaxMethod method = RelaxMethod::lbfgs, std::uint64_t iterations = 50) {
  RelaxOptions options{};
  options.domain = {0, 0, 1, 1};
  options.method = method;
  options.iterations = iterations;
  return options;
}

Relaxed relaxed(const Sites& sites, const RelaxOptions& options) {
  Session session = sessionOf();
  auto done = relax(session, sites, options);
  EXPECT_TRUE(done) << (done ? "" : done.error().message);
  return done ? std::move(*done) : Relaxed{};
}

/// The letter L: its bend is where centroids may lie outside.
Outline letter() { return {{{0, 0}, {1, 0}, {1, 0.2}, {0.2, 0.2}, {0.2, 1}, {0, 1}}, {0, 6}, {0, 1}}; }

double energyAt(Session& session, const Sites& sites, const RelaxOptions& options) {
  return Relaxation::begin(session, sites, options).value().trace().front().energy;
}

/// 2 m (p - c) against differences of the energy.
void expectGradient(const Sites& sites, const RelaxOptions& options) {
  Session session = sessionOf();
  CellsOptions cells{};
  cells.domain = options.domain;
  cells.outline = options.outline;
  cells.periodic = options.periodic;
  cells.density = options.density;
  MovingCells moving(session, cells);
  ASSERT_TRUE(moving.update(sites));
  const CellMoments moments = moving.moments();
  constexpr double step = 1e-5;
  for (std::size_t i = 0; i < sites.size(); i += 7) {
    for (const auto coordinate : {&Sites::x, &Sites::y}) {
      Sites ahead = sites, behind = sites;
      (ahead.*coordinate)[i] += step;
      (behind.*coordinate)[i] -= step;
      const double slope =
          (energyAt(session, ahead, options) - energyAt(session, behind, options)) / (2 * step);
      const double center = coordinate == &Sites::x ? moments.centroid[i].x : moments.centroid[i].y;
      EXPECT_NEAR(slope, 2 * moments.mass[i] * ((sites.*coordinate)[i] - center), 2e-9) << "site " << i;
    }
  }
}

TEST(Relaxation, TheGradientIsThatOfTheEnergy) {
  Sites sites = generate(Pattern::jitter, 60, 3);
  RelaxOptions options = relaxOptions();
  expectGradient(sites, options);
  options.density = blob(23, 0.05);
  expectGradient(sites, options);
  for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(1e-3 * static_cast<double>(i % 5));
  expectGradient(sites, options);
  options.outline = letter();
  expectGradient(sites, options);
  options.outline = {};
  options.periodic = Periodic::xy;
  expectGradient(sites, options);
}

void expectFall(const Sites& sites, const RelaxOptions& options) {
  const Relaxed done = relaxed(sites, options);
  ASSERT_EQ(done.trace.size(), options.iterations + 1);
  for (std::size_t k = 1; k < done.trace.size(); ++k) {
    EXPECT_LT(done.trace[k].energy, done.trace[k - 1].energy) << "diagram " << k;
    EXPECT_EQ(done.trace[k].diagram, k);
  }
}

TEST(Relaxation, EnergyFallsAtEveryStepOfLloyds) {
  Sites sites = generate(Pattern::random, 500, 1);
  RelaxOptions options = relaxOptions(RelaxMethod::lloyd, 30);
  expectFall(sites, options);
  options.periodic = Periodic::x;
  expectFall(sites, options);
  options.periodic = Periodic::none;
  options.density = blob(40, 0.05);
  expectFall(sites, options);
  options.outline = letter();
  expectFall(sites, options);
  options.outline = {};
  for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(1e-4 * static_cast<double>(i % 5));
  expectFall(sites, options);
}

TEST(Relaxation, TheAcceleratedMethodIsAsFarAfter35DiagramsAsLloydsAfter200) {
  const Sites few = generate(Pattern::random, 3000, 1), sites = generate(Pattern::random, 10000, 1);
  const Relaxed slow = relaxed(few, relaxOptions(RelaxMethod::lloyd, 200));
  const Relaxed fast = relaxed(few, relaxOptions(RelaxMethod::lbfgs, 35));
  EXPECT_LE(fast.trace[35].energy, slow.trace[200].energy);
  EXPECT_LE(relaxed(sites, relaxOptions()).trace[50].hexagonal, 1.013);
  RelaxOptions periodic = relaxOptions();
  periodic.periodic = Periodic::xy;
  const Relaxed torus = relaxed(sites, periodic);
  EXPECT_LE(torus.trace[50].hexagonal, 1.0115);
  EXPECT_GE(torus.trace[50].hexagonal, 1);
  for (const double x : torus.sites.x) EXPECT_TRUE(x >= 0 && x < 1) << x;
}

TEST(Relaxation, DiagramsThatAreTakenBackSaySo) {
  const Sites sites = generate(Pattern::clusters, 300, 2);
  RelaxOptions options = relaxOptions(RelaxMethod::lbfgs, 80);
  options.density = blob(40, 0.05);
  const Relaxed done = relaxed(sites, options);
  EXPECT_THAT(done.trace, Contains(Field(&RelaxStep::taken, false)));
  double energy = done.trace.front().energy;
  for (const RelaxStep& step : done.trace) {
    EXPECT_EQ(step.taken, step.energy <= energy) << "diagram " << step.diagram;
    if (step.taken) energy = step.energy;
  }
  EXPECT_EQ(lastTaken(done.trace).energy, energy);
  Session session = sessionOf();
  EXPECT_NEAR(energyAt(session, done.sites, options), energy, 1e-12 * energy);
}

TEST(Relaxation, TheHexagonalLatticeStays) {
  constexpr int columns = 12, rows = 14;
  const double high = std::sqrt(0.75);
  Sites sites;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      sites.x.push_back(column + (row % 2 == 0 ? 0.25 : 0.75));
      sites.y.push_back((row + 0.5) * high);
    }
  }
  for (const RelaxMethod method : {RelaxMethod::lloyd, RelaxMethod::lbfgs}) {
    RelaxOptions options = relaxOptions(method, 10);
    options.domain = {0, 0, columns, rows * high};
    options.periodic = Periodic::xy;
    const Relaxed done = relaxed(sites, options);
    for (const RelaxStep& step : done.trace) {
      EXPECT_NEAR(step.hexagonal, 1, 1e-12);
      EXPECT_GE(step.hexagonal, 1 - 1e-14);
    }
    for (std::size_t i = 0; i < sites.size(); ++i) {
      EXPECT_NEAR(done.sites.x[i], sites.x[i], 1e-12);
      EXPECT_NEAR(done.sites.y[i], sites.y[i], 1e-12);
    }
  }
}

class RelaxationOn : public ::testing::TestWithParam<const char*> {};

TEST_P(RelaxationOn, SitesComeToThePlacesOfTheCpu) {
  SKIP_UNUSABLE(GetParam());
  Session session = sessionOf(GetParam());
  const Sites sites = generate(Pattern::random, 400, 5);
  const RelaxOptions options = relaxOptions(RelaxMethod::lbfgs, 20);
  const Relaxed judge = relaxed(sites, options);
  const auto done = relax(session, sites, options);
  ASSERT_TRUE(done) << done.error().message;
  constexpr double slack = 1e-6 / 20;  // of the spacing
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_NEAR(done->sites.x[i], judge.sites.x[i], slack) << "site " << i;
    EXPECT_NEAR(done->sites.y[i], judge.sites.y[i], slack) << "site " << i;
  }
}
INSTANTIATE_TEST_SUITE_P(Backends, RelaxationOn,
                         ::testing::Values("vulkan-geometry", "vulkan-compute", "opengl"));

TEST(Relaxation, ThreadsChangeNothing) {
  const Sites sites = generate(Pattern::clusters, 3000, 2);
  Session one = sessionOf("cpu", 1), four = sessionOf("cpu", 4);
  const auto a = relax(one, sites, relaxOptions(RelaxMethod::lbfgs, 10));
  const auto b = relax(four, sites, relaxOptions(RelaxMethod::lbfgs, 10));
  EXPECT_EQ(a.value().sites.x, b.value().sites.x);
  EXPECT_EQ(a.value().sites.y, b.value().sites.y);

  std::vector<double> gradient(100000), inverse(gradient.size(), 0.5), step = gradient, change = gradient;
  for (std::size_t k = 0; k < gradient.size(); ++k) {
    gradient[k] = std::sin(static_cast<double>(k));
    step[k] = std::cos(static_cast<double>(k));
    change[k] = step[k] * (1 + 0.5 * gradient[k]);
  }
  std::vector<double> of_one, of_four;
  for (auto [threads, to] : {std::pair{1, &of_one}, {4, &of_four}}) {
    moving::QuasiNewton newton(threads);
    newton.add(step, change);
    newton.add(change, step);
    newton.direction(gradient, inverse, *to);
  }
  EXPECT_EQ(of_one, of_four);
}

/// On a quadratic with a diagonal Hessian the pair of a step makes the direction exact along that step.
TEST(QuasiNewton, KnowsTheCurvatureAlongItsSteps) {
  moving::QuasiNewton newton(1);
  std::vector<double> direction;
  newton.direction({2, 4}, {0.5, 0.25}, direction);
  EXPECT_EQ(direction, (std::vector<double>{-1, -1}));
  newton.add({1, 0}, {8, 0});
  newton.add({0, 1}, {0, 3});
  newton.add({1, 1}, {-1, -1});  // bends downward: is not kept
  newton.direction({2, 4}, {0.5, 0.25}, direction);
  EXPECT_NEAR(direction[0], -2.0 / 8, 1e-15);
  EXPECT_NEAR(direction[1], -4.0 / 3, 1e-15);
}

TEST(Relaxation, SitesThatOwnNothingGetPlaces) {
  Sites sites = generate(Pattern::random, 50, 1);
  for (int k = 0; k < 5; ++k) {
    sites.x.push_back(sites.x[0]);
    sites.y.push_back(sites.y[0]);
  }
  // Both come to the same corner, and so are set beside each other.
  sites.x.insert(sites.x.end(), {7, 8});
  sites.y.insert(sites.y.end(), {5, 5.5});
  RelaxOptions options = relaxOptions(RelaxMethod::lloyd, 12);
  const Relaxed done = relaxed(sites, options);
  EXPECT_EQ(done.report.ok, sites.size());
  EXPECT_THAT(done.report.notes, Contains(HasSubstr("6 sites at the place of another")));
  for (std::size_t k = 1; k < done.trace.size(); ++k)
    EXPECT_LT(done.trace[k].energy, done.trace[k - 1].energy);

  // Nothing but the left half has mass.
  options.density = {2, 1, {1, 0}};
  const Relaxed half = relaxed(sites, options);
  EXPECT_THAT(half.report.notes, Contains(HasSubstr("in cells without mass")));
  EXPECT_LT(*std::ranges::max_element(half.sites.x), 0.5);

  // One that a heavier one hides stays.
  options.density = {};
  Sites weighted{{0.5, 0.52, 0.1}, {0.5, 0.5, 0.9}, {0.3, 0, 0}};
  const Relaxed hidden = relaxed(weighted, options);
  EXPECT_EQ(hidden.sites.x[1], 0.52);
  EXPECT_THAT(hidden.report.notes, Contains(HasSubstr("1 site without a cell, hidden")));
}

TEST(Stipple, EachPieceOfTheMassGetsASite) {
  Density density{4, 2, {0, 0, 1, 3, 0, 2, 1, 1}};
  const Box domain{10, 20, 14, 22};
  const Sites sites = drawnFrom(density, domain, {}, 800, 1).value();
  std::vector<int> count(8);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto column = static_cast<std::size_t>(sites.x[i] - 10),
               row = static_cast<std::size_t>(22 - sites.y[i]);
    ++count.at(4 * row + column);
  }
  for (std::size_t k = 0; k < count.size(); ++k) EXPECT_NEAR(count[k], 100 * density.values[k], 1) << k;
  EXPECT_EQ(drawnFrom(density, domain, {}, 800, 1).value().x, sites.x);
  EXPECT_NE(drawnFrom(density, domain, {}, 800, 2).value().x, sites.x);
  // The left half of the domain has no mass above its lower row.
  const Outline empty{{{10, 21}, {12, 21}, {12, 22}, {10, 22}}, {0, 4}, {0, 1}};
  EXPECT_THAT(drawnFrom(density, domain, empty, 10, 1).error().message, HasSubstr("no mass inside"));
  for (const Box& wrong : {Box{14, 22, 10, 20}, Box{10, 20, std::nan(""), 22}}) {
    EXPECT_EQ(drawnFrom(density, wrong, {}, 10, 1).error().subject, Subject::domain);
  }
  density.values = {0, 0, 1, 3, 0, 2, 1, -1};
  EXPECT_EQ(drawnFrom(density, domain, {}, 10, 1).error().subject, Subject::density);
  density.values.assign(8, 0);
  EXPECT_EQ(drawnFrom(density, domain, {}, 10, 1).error().subject, Subject::density);
}

TEST(Stipple, CellsComeToHaveEqualMasses) {
  const Density density = blob(100, 0.05);
  RelaxOptions options = relaxOptions(RelaxMethod::lbfgs, 100);
  options.density = density;
  options.equal_masses = true;
  const Relaxed done = relaxed(drawnFrom(density, options.domain, {}, 1000, 1).value(), options);
  Session session = sessionOf();
  CellsOptions cells{};
  cells.domain = options.domain;
  cells.density = density;
  const Diagram diagram = session.cells(done.sites, cells).value();
  double mean = 0;
  for (const double mass : diagram.mass) mean += mass / 1000;
  const auto [least, most] = std::ranges::minmax(diagram.mass);
  EXPECT_GT(least, 0.98 * mean);
  EXPECT_LT(most, 1.02 * mean);
  EXPECT_LE(done.trace.size(), 101u);
}

TEST(Relaxation, SitesStayInTheOutline) {
  RelaxOptions options = relaxOptions();
  options.outline = letter();
  const moving::AllowedPlaces allowed(options.domain, options.outline, Periodic::none);
  for (const RelaxMethod method : {RelaxMethod::lloyd, RelaxMethod::lbfgs}) {
    options.method = method;
    // With so few sites the one in the bend has its centroid outside.
    for (const std::uint64_t count : {1U, 3U, 200U}) {
      const Relaxed done = relaxed(generate(Pattern::random, count, 4), options);
      for (std::size_t i = 0; i < done.sites.size(); ++i) {
        EXPECT_TRUE(allowed.contain({done.sites.x[i], done.sites.y[i]})) << count << ", site " << i;
      }
      EXPECT_EQ(done.report.ok, count);
    }
  }
  const Point near = allowed.nearestTo({0.5, 0.3});
  EXPECT_NEAR(near.x, 0.5, 1e-8);
  EXPECT_NEAR(near.y, 0.2, 1e-8);
}

TEST(Relaxation, SitesThatDoNotMoveAreThoseThatWereGiven) {
  RelaxOptions options = relaxOptions(RelaxMethod::lbfgs, 0);
  options.domain = {0, 0, 3, 0.7};
  options.periodic = Periodic::xy;
  const Sites sites{{0.1, 1.2, -2.9, 7.3}, {0.1, 0.6, 0.3, 1.1}, {}};
  const Relaxed done = relaxed(sites, options);
  EXPECT_EQ(done.sites.x, sites.x);
  EXPECT_EQ(done.sites.y, sites.y);
}

TEST(Relaxation, Ends) {
  const Sites sites = generate(Pattern::random, 40, 1);
  RelaxOptions options = relaxOptions(RelaxMethod::lbfgs, 2000);
  options.tolerance = 1e-3;
  const Relaxed near = relaxed(sites, options);
  EXPECT_EQ(near.end, RelaxEnd::tolerance);
  EXPECT_LE(near.trace.back().farthest, 1e-3);
  options.tolerance = 0;
  const Relaxed nearest = relaxed(sites, options);
  EXPECT_EQ(nearest.end, RelaxEnd::stagnated);
  EXPECT_LT(nearest.trace.size(), 1000u);
  EXPECT_LT(nearest.trace.back().farthest, 1e-6);
  options.iterations = 0;
  const Relaxed none = relaxed(sites, options);
  EXPECT_EQ(none.end, RelaxEnd::iterations);
  EXPECT_EQ(none.sites.x, sites.x);

  // A caller that stops has the sites of the last step that was done.
  Session session = sessionOf();
  options.iterations = 10;
  const auto three = relax(session, sites, options, [](const Relaxation& r) { return r.trace().size() < 4; });
  EXPECT_EQ(three.value().end, RelaxEnd::cancelled);
  bool stop = false;
  options.progress = [&](std::string_view, double) { return !stop; };
  const auto cut = relax(session, sites, options, [&](const Relaxation& r) {
    stop = r.trace().size() == 4;
    return true;
  });
  EXPECT_EQ(cut.value().end, RelaxEnd::cancelled);
  EXPECT_EQ(cut.value().sites.x, three.value().sites.x);
  stop = true;
  EXPECT_EQ(relax(session, sites, options).error().code, ErrorCode::cancelled);
  options.progress = {};
  EXPECT_EQ(relax(session, {}, options).error().code, ErrorCode::input);
}

}  // namespace
}  // namespace vorpipe::test
