#include "vorpipe/fluid.h"
#include "unit/fixtures/cpu_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "moving/linear/mass_change.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

/// What a run came to, and what it was on the way.
struct Ran {
  FluidState state;
  FluidStep first, last;
  double drift = 0, worst = 0;
  std::uint64_t steps = 0;
};

Ran runSteps(Session& session, const FluidSetup& setup, std::uint64_t most = UINT64_MAX) {
  Ran ran;
  auto fluid = Fluid::begin(session, setup.state, setup.options);
  EXPECT_TRUE(fluid) << fluid.error().message;
  if (!fluid) return ran;
  ran.first = fluid->last();
  for (; ran.steps < most; ++ran.steps) {
    const auto more = fluid->step();
    EXPECT_TRUE(more);
    if (!more || !*more) break;
    ran.drift = std::max(ran.drift, std::abs(fluid->last().energy() / ran.first.energy() - 1));
    ran.worst = std::max(ran.worst, fluid->last().worst);
  }
  ran.state = fluid->state();
  ran.last = fluid->last();
  return ran;
}

double velocityError(FluidCase which, const FluidSetup& setup, const FluidState& state) {
  double error = 0, whole = 0;
  for (std::size_t i = 0; i < state.sites.size(); ++i) {
    const Point exact = *steadyVelocity(which, {state.sites.x[i], state.sites.y[i]});
    error += std::pow(state.velocity[i].x - exact.x, 2) + std::pow(state.velocity[i].y - exact.y, 2);
    whole += std::pow(setup.state.velocity[i].x, 2) + std::pow(setup.state.velocity[i].y, 2);
  }
  return std::sqrt(error / whole);
}

FluidSetup taylorGreen(std::uint64_t parcels, FluidScheme scheme, double step_in_spacings) {
  FluidSetup setup = fluidCase(FluidCase::taylor_green, parcels);
  setup.options.scheme = scheme;
  setup.options.step = step_in_spacings / std::sqrt(static_cast<double>(parcels));
  return setup;
}

TEST(Fluid, SpringsKeepEnergyToTheSecondOrder) {
  Session session = test::cpuSession();
  const Ran coarse = runSteps(session, taylorGreen(256, FluidScheme::springs, 0.5));
  const Ran fine = runSteps(session, taylorGreen(256, FluidScheme::springs, 0.25));
  EXPECT_EQ(coarse.steps, 16U);
  EXPECT_LE(coarse.drift, 1e-3);
  EXPECT_LE(fine.drift, coarse.drift / 3.5);
  EXPECT_LE(std::max(coarse.worst, fine.worst), 1e-6);
  EXPECT_NEAR(coarse.last.momentum.x, 0, 1e-9);
}

TEST(Fluid, ReflectionIsOfSecondOrder) {
  Session session = test::cpuSession();
  const FluidSetup small = taylorGreen(256, FluidScheme::projection, 0.5);
  const FluidSetup large = taylorGreen(576, FluidScheme::projection, 0.5);
  const Ran coarse = runSteps(session, small), fine = runSteps(session, large);
  const double error = velocityError(FluidCase::taylor_green, small, coarse.state);
  const double less = velocityError(FluidCase::taylor_green, large, fine.state);
  EXPECT_LE(error, 0.16);
  EXPECT_GE(std::log(error / less) / std::log(1.5), 1.7);
  EXPECT_NEAR(fine.last.kinetic / fine.first.kinetic, 1, 1e-4);
}

/// Across a change of the order in memory, which comes after 32 steps.
TEST(Fluid, GoesOnFromAStateToTheSameBytes) {
  for (const auto scheme : {FluidScheme::springs, FluidScheme::projection}) {
    Session session = test::cpuSession();
    FluidSetup setup = taylorGreen(64, scheme, 0);
    setup.options.until = 10;
    const Ran whole = runSteps(session, setup, 34);
    setup.state = runSteps(session, setup, 31).state;
    EXPECT_EQ(setup.state.step, 31U);
    Session other = test::cpuSession(1);
    const Ran rest = runSteps(other, setup, 3);
    EXPECT_EQ(rest.state.step, 34U);
    EXPECT_EQ(rest.state.time, whole.state.time);
    EXPECT_EQ(rest.state.sites.x, whole.state.sites.x);
    EXPECT_EQ(rest.state.sites.weight, whole.state.sites.weight);
    EXPECT_EQ(rest.state.velocity, whole.state.velocity);
    EXPECT_EQ(rest.state.pressure, whole.state.pressure);
  }
}

TEST(Fluid, AreasChangeAsTheDerivativesSay) {
  Session session = test::cpuSession();
  const Sites sites = generate(Pattern::jitter, 36, 4);
  const Box box{0, 0, 1, 1};
  MovingCells cells(session, {.domain = box, .search = {}, .progress = {}});
  ASSERT_TRUE(cells.update(sites));
  std::vector<Point> velocity;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    velocity.push_back({std::sin(7.0 * static_cast<double>(i)), std::cos(3.0 * static_cast<double>(i))});
  }
  std::vector<double> change;
  moving::MassChange(cells, sites, box, 1).apply(velocity, change);
  constexpr double step = 1e-6;
  const auto areasAfter = [&](double time) {
    Sites moved = sites;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      moved.x[i] += time * velocity[i].x;
      moved.y[i] += time * velocity[i].y;
    }
    EXPECT_TRUE(cells.update(moved));
    return cells.moments().area;
  };
  const std::vector<double> after = areasAfter(step), before = areasAfter(-step);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_NEAR(change[i], (after[i] - before[i]) / (2 * step), 1e-7);
  }
}

TEST(Fluid, RefusesWhatDoesNotFit) {
  Session session = test::cpuSession();
  const auto refused = [&](const auto& spoil) {
    FluidSetup setup = fluidCase(FluidCase::taylor_green, 16);
    spoil(setup);
    const auto fluid = Fluid::begin(session, setup.state, setup.options);
    EXPECT_FALSE(fluid);
    return fluid ? std::string() : fluid.error().message;
  };
  EXPECT_EQ(refused([](FluidSetup& s) { s.state.velocity.pop_back(); }),
            "velocity: there is not one for each site");
  EXPECT_EQ(refused([](FluidSetup& s) { s.state.density = {1}; }), "density: there is not one for each site");
  EXPECT_EQ(refused([](FluidSetup& s) { s.state.trend = {0, 0}; }), "trend: there is not one for each site");
  EXPECT_EQ(refused([](FluidSetup& s) { s.state.order.assign(16, 0); }),
            "order: it does not name each site once");
  EXPECT_EQ(refused([](FluidSetup& s) { s.options.step = -1; }), "step: it is not 0 or more");
  EXPECT_EQ(refused([](FluidSetup& s) { s.state.velocity[3].x = NAN; }),
            "velocity: it is not finite, or beyond 1e+50");
  EXPECT_EQ(refused([](FluidSetup& s) {
              s.options.scheme = FluidScheme::projection;
              s.options.surface = Surface::free;
            }),
            "scheme: projection is for domains that are full; springs have free surfaces");
}

TEST(Fluid, RefusesVolumesThatDoNotFillTheDomain) {
  Session session = test::cpuSession();
  FluidSetup setup = fluidCase(FluidCase::taylor_green, 16);
  setup.state.volume.assign(16, 1);
  EXPECT_EQ(Fluid::begin(session, setup.state, setup.options).error().message,
            "volume: they add up to 16, and the area of the domain is 1");
  setup = fluidCase(FluidCase::dam_break, 50);
  for (double& volume : setup.state.volume) volume *= 7;
  EXPECT_FALSE(Fluid::begin(session, setup.state, setup.options));
}

TEST(Fluid, HalvesStepsThatLeadSitesWhereTheyHaveNoCells) {
  Session session = test::cpuSession();
  FluidSetup setup = fluidCase(FluidCase::dam_break, 500);
  setup.options.step = 0.05;
  setup.options.until = 0.5;
  std::uint64_t halvings = 0;
  auto fluid = Fluid::begin(session, setup.state, setup.options);
  ASSERT_TRUE(fluid);
  for (auto more = fluid->step(); *more; more = fluid->step()) halvings += fluid->last().halvings;
  EXPECT_GT(halvings, 0u);
  EXPECT_EQ(fluid->end(), FluidEnd::time);
  EXPECT_LE(fluid->last().worst, setup.options.tolerance);
}

TEST(Fluid, EndsWhereNoStepIsShortEnough) {
  Session session = test::cpuSession();
  FluidSetup setup = fluidCase(FluidCase::taylor_green, 64);
  setup.options.step = 0.1;
  // Not all the same way, which would leave cells as they are.
  for (std::size_t i = 0; i < setup.state.velocity.size(); ++i)
    setup.state.velocity[i] = {i % 2 == 0 ? 1e40 : -1e40, 0};
  auto fluid = Fluid::begin(session, setup.state, setup.options);
  ASSERT_TRUE(fluid);
  const auto more = fluid->step();
  ASSERT_TRUE(more) << more.error().message;
  EXPECT_FALSE(*more);
  EXPECT_EQ(fluid->end(), FluidEnd::areas);
}

TEST(Fluid, RefusesStepsThatAreNothingBesideTheTime) {
  Session session = test::cpuSession();
  FluidSetup setup = fluidCase(FluidCase::taylor_green, 16);
  setup.state.time = 1e20;
  setup.options.until = 1e30;
  setup.options.step = 1;
  auto fluid = Fluid::begin(session, setup.state, setup.options);
  ASSERT_TRUE(fluid);
  EXPECT_EQ(fluid->step().error().message, "step: one of 1 is nothing beside the time, 1e+20");
}

TEST(Fluid, IsPushedAtEachSite) {
  Session session = test::cpuSession();
  const FluidSetup setup = fluidCase(FluidCase::taylor_green, 16);
  auto fluid = Fluid::begin(session, setup.state, setup.options);
  ASSERT_TRUE(fluid);
  EXPECT_EQ(fluid->push({{1, 0}}).error().message, "velocities: 1 for 16 sites");
  std::vector<Point> more(16, Point{0, 0});
  more[3].x = NAN;
  EXPECT_EQ(fluid->push(more).error().message, "velocities: that of site 3 is not finite, or beyond 1e+50");
  EXPECT_EQ(fluid->state().velocity, setup.state.velocity);
  more[3] = {1, 2};
  EXPECT_TRUE(fluid->push(more));
  EXPECT_EQ(fluid->state().velocity[3].y, setup.state.velocity[3].y + 2);
  EXPECT_EQ(fluid->state().velocity[4], setup.state.velocity[4]);
}

/// Whether its diagrams ask or are too small for that.
TEST(Fluid, StopsWhereProgressSaysSo) {
  Session session = test::cpuSession();
  for (const std::uint64_t parcels : {4u, 64u, 250u}) {
    FluidSetup setup = taylorGreen(parcels, FluidScheme::springs, 0.1);
    setup.options.until = 1e9;
    bool go_on = true;
    setup.options.progress = [&](std::string_view, double) { return go_on; };
    auto fluid = Fluid::begin(session, setup.state, setup.options);
    ASSERT_TRUE(fluid);
    for (int step = 0; step < 50; ++step) EXPECT_TRUE(fluid->step().value());
    go_on = false;
    EXPECT_FALSE(fluid->step().value());
    EXPECT_EQ(fluid->end(), FluidEnd::cancelled);
  }
}

TEST(Fluid, IsAsItWasBeforeAStepThatIsStopped) {
  Session session = test::cpuSession();
  FluidSetup setup = taylorGreen(64, FluidScheme::springs, 0.5);
  bool go_on = true;
  setup.options.progress = [&](std::string_view, double) { return go_on; };
  auto fluid = Fluid::begin(session, setup.state, setup.options);
  ASSERT_TRUE(fluid);
  EXPECT_TRUE(fluid->step().value());
  const FluidState before = fluid->state();
  go_on = false;
  EXPECT_FALSE(fluid->step().value());
  EXPECT_EQ(fluid->end(), FluidEnd::cancelled);
  EXPECT_EQ(fluid->state().sites.x, before.sites.x);
}

}  // namespace
}  // namespace vorpipe
