#include "vorpipe/fluid.h"
#include "unit/fixtures/cpu_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "motion/flow.h"
#include "motion/linear/mass_change.h"
#include "motion/movable.h"
#include "motion/viscosity.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// What a run came to, and what it was on the way.
struct Ran {
  FluidState state;
  FluidStep first, last;
  double drift = 0, worst = 0;
  std::uint64_t steps = 0;
  bool has_exploded = false;
  std::vector<std::string> notes;
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
  ran.has_exploded = fluid->hasExploded();
  ran.notes = fluid->report().notes;
  return ran;
}

double velocityError(const FluidSetup& setup, const FluidState& state) {
  double error = 0, whole = 0;
  for (std::size_t i = 0; i < state.sites.size(); ++i) {
    const Point exact = exactVelocity(setup.options, {state.sites.x[i], state.sites.y[i]}, state.time);
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
  const double error = velocityError(small, coarse.state);
  const double less = velocityError(large, fine.state);
  EXPECT_LE(error, 0.16);
  EXPECT_NEAR(*coarse.last.velocity_error, error, 0.02 * error);
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
  FluidSetup setup = taylorGreen(64, FluidScheme::springs, 0.8);
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

/// The same fluid in other units: so many of them are a meter, a second and the unit of mass.
FluidSetup inUnits(FluidSetup setup, double length, double time, double mass) {
  FluidOptions& options = setup.options;
  FluidState& state = setup.state;
  options.domain = {options.domain.xmin * length, options.domain.ymin * length, options.domain.xmax * length,
                    options.domain.ymax * length};
  options.gravity.x *= length / (time * time);
  options.gravity.y *= length / (time * time);
  options.viscosity *= length * length / time;
  options.centering /= time;
  options.until *= time;
  for (double& x : state.sites.x) x *= length;
  for (double& y : state.sites.y) y *= length;
  for (Point& v : state.velocity) v = {v.x * length / time, v.y * length / time};
  for (double& volume : state.volume) volume *= length * length;
  state.density.resize(state.sites.size(), 1);
  for (double& density : state.density) density *= mass / (length * length);
  return setup;
}

TEST(Fluid, IsTheSameInOtherUnits) {
  Session session = test::cpuSession();
  struct Units {
    double length, time, mass;
  };
  using Flow = std::pair<FluidCase, FluidScheme>;
  for (const auto& [which, scheme] :
       {Flow{FluidCase::taylor_green, FluidScheme::springs}, Flow{FluidCase::dam_break, FluidScheme::springs},
        Flow{FluidCase::rayleigh_taylor, FluidScheme::springs},
        Flow{FluidCase::taylor_green, FluidScheme::projection},
        Flow{FluidCase::rayleigh_taylor, FluidScheme::projection}}) {
    FluidSetup setup = fluidCase(which, 128);
    setup.options.scheme = scheme;
    setup.options.until = which == FluidCase::rayleigh_taylor ? 0.5 : 0.15;
    const Ran meters = runSteps(session, setup);
    for (const auto& [length, time, mass] : {Units{100, 1, 1}, Units{1e-3, 1, 1}, Units{1, 1e3, 1e3}}) {
      const Ran other = runSteps(session, inUnits(setup, length, time, mass));
      EXPECT_EQ(other.steps, meters.steps);
      EXPECT_TRUE(other.notes.empty());
      for (std::size_t i = 0; i < setup.state.sites.size(); ++i) {
        EXPECT_NEAR(other.state.sites.x[i] / length, meters.state.sites.x[i], 1e-9);
        EXPECT_NEAR(other.state.sites.y[i] / length, meters.state.sites.y[i], 1e-9);
      }
      const double energy = length * length / (time * time) * mass;
      EXPECT_NEAR(other.last.kinetic / energy, meters.last.kinetic, 1e-9);
      EXPECT_NEAR(other.last.spring / energy, meters.last.spring, 1e-9);
    }
  }
}

TEST(Fluid, LosesTheEnergyOfItsFallThroughAPeriod) {
  Session session = test::cpuSession();
  for (const auto scheme : {FluidScheme::springs, FluidScheme::projection}) {
    FluidSetup setup = fluidCase(FluidCase::shear, 64);
    setup.state.velocity.assign(64, Point{0, 0});
    setup.options.scheme = scheme;
    setup.options.gravity = {0.3, -1};
    setup.options.until = 3;
    const Ran whole = runSteps(session, setup);
    EXPECT_GT(whole.last.kinetic, 4);
    // Where steps of a projection fall, they gain what is of first order in their length.
    const double drift = scheme == FluidScheme::springs ? 1e-6 : 0.06;
    EXPECT_NEAR(whole.last.energy(), whole.first.energy(), drift);
    // One that goes on knows how far it has fallen.
    setup.options.until = 2;
    setup.state = runSteps(session, setup).state;
    EXPECT_GT(setup.state.carried.y, 0);
    setup.options.until = 3;
    EXPECT_NEAR(runSteps(session, setup).last.energy(), whole.first.energy(), drift);
  }
}

TEST(Fluid, TellsOfStepsThatSpringsDoNotStand) {
  Session session = test::cpuSession();
  FluidSetup setup = taylorGreen(256, FluidScheme::springs, 0);
  setup.options.step = 0.3;
  setup.options.until = 3;
  const Ran ran = runSteps(session, setup);
  EXPECT_TRUE(ran.has_exploded);
  ASSERT_EQ(ran.notes.size(), 2u);
  EXPECT_THAT(ran.notes[0], HasSubstr("step: 0.3 is longer than the 0.25"));
  EXPECT_THAT(ran.notes[0], HasSubstr("springs of epsilon 0.12"));
  EXPECT_THAT(ran.notes[1], HasSubstr("out of nothing: steps are too long"));
  setup.options.step = 0;
  const Ran right = runSteps(session, setup, 20);
  EXPECT_FALSE(right.has_exploded);
  EXPECT_TRUE(right.notes.empty());
}

TEST(Fluid, TellsOfSpringsThatDoNotGoWithItsSpeeds) {
  Session session = test::cpuSession();
  const auto notesFor = [&](double epsilon, double speed) {
    FluidSetup setup = taylorGreen(64, FluidScheme::springs, 0);
    for (Point& v : setup.state.velocity) v = {speed * v.x, speed * v.y};
    setup.options.epsilon = epsilon;
    auto fluid = Fluid::begin(session, setup.state, setup.options);
    EXPECT_TRUE(fluid);
    return fluid->report().notes;
  };
  EXPECT_TRUE(notesFor(0.25, 1).empty());
  EXPECT_THAT(notesFor(0.25, 100), ElementsAre(HasSubstr("too soft for speeds of ")));
  EXPECT_THAT(notesFor(0.25, 0.01), ElementsAre(HasSubstr("too stiff for speeds of ")));
  EXPECT_THAT(notesFor(0, 0), ElementsAre(HasSubstr("nothing moves and nothing pulls")));
}

TEST(Fluid, TellsOnceOfSpringsThatAreTooSoft) {
  Session session = test::cpuSession();
  FluidSetup setup = taylorGreen(64, FluidScheme::springs, 0);
  setup.options.epsilon = 25;
  setup.options.step = 0.01;
  EXPECT_THAT(runSteps(session, setup, 2).notes, ElementsAre(HasSubstr("too soft for speeds of ")));
}

TEST(Fluid, TellsOfSitesBeyondWalls) {
  Session session = test::cpuSession();
  FluidSetup setup = fluidCase(FluidCase::taylor_green, 64);
  setup.state.sites.y[5] = -4;
  auto fluid = Fluid::begin(session, setup.state, setup.options);
  ASSERT_TRUE(fluid) << fluid.error().message;
  EXPECT_THAT(fluid->report().notes,
              ElementsAre(HasSubstr("1 of 64 sites lie beyond the domain, up to 32 spacings")));
}

TEST(Fluid, IsByProjectionWhereItFillsItsDomain) {
  Session session = test::cpuSession();
  for (const auto& [which, scheme] : {std::pair(FluidCase::shear, FluidScheme::projection),
                                      std::pair(FluidCase::dam_break, FluidScheme::springs)}) {
    const FluidSetup setup = fluidCase(which, 32);
    EXPECT_EQ(setup.options.scheme, FluidScheme::automatic);
    EXPECT_EQ(Fluid::begin(session, setup.state, setup.options)->options().scheme, scheme);
  }
}

/// Returns how much the rate at which the kinetic energy decays differs from 2 viscosity k^2, relative to it.
double errorOfDecay(Session& session, FluidCase which, std::uint64_t parcels, double squared_wave,
                    double viscosity) {
  FluidSetup setup = fluidCase(which, parcels);
  setup.options.viscosity = viscosity;
  const Ran ran = runSteps(session, setup);
  EXPECT_LE(ran.worst, 1e-6);
  EXPECT_LE(*ran.last.velocity_error, 0.06);
  const double rate = std::log(ran.first.kinetic / ran.last.kinetic) / ran.last.time;
  return rate / (2 * viscosity * squared_wave) - 1;
}

TEST(Fluid, SlowsDownByItsViscosityAsTheorySays) {
  Session session = test::cpuSession();
  constexpr double pi = std::numbers::pi;
  for (const double viscosity : {0.02, 0.05}) {
    EXPECT_NEAR(errorOfDecay(session, FluidCase::taylor_green, 576, 2 * pi * pi, viscosity), 0, 0.01);
    const double error = errorOfDecay(session, FluidCase::shear_wave, 576, 4 * pi * pi, viscosity);
    EXPECT_NEAR(error, 0, 0.01);
    const double less = errorOfDecay(session, FluidCase::shear_wave, 1296, 4 * pi * pi, viscosity);
    EXPECT_GE(std::log(error / less) / std::log(1.5), 1.7) << error << " and " << less;
  }
}

TEST(Fluid, SticksToTheWallsOfAChannel) {
  Session session = test::cpuSession();
  const Ran coarse = runSteps(session, fluidCase(FluidCase::channel, 144));
  const Ran fine = runSteps(session, fluidCase(FluidCase::channel, 576));
  EXPECT_LE(*fine.last.velocity_error, 0.004);
  EXPECT_GE(*coarse.last.velocity_error / *fine.last.velocity_error, 3);
  // Without friction it would have fallen at the speed of 1.
  FluidSetup slips = fluidCase(FluidCase::channel, 144);
  slips.options.walls = FluidWalls::slip;
  const Ran free = runSteps(session, slips);
  EXPECT_NEAR(free.last.kinetic, 0.5, 1e-6);
  EXPECT_FALSE(free.last.velocity_error);
}

/// The cells are far from centroidal, and the flow is a wave across the periodic square.
TEST(Fluid, HasFrictionThatIsRightOnIrregularCells) {
  Session session = test::cpuSession();
  FluidOptions options{};
  options.domain = {0, 0, 1, 1};
  options.periodic = Periodic::xy;
  options.viscosity = 0.01;
  FluidState state;
  state.sites = generate(Pattern::random, 4000, 7);
  const std::size_t count = state.sites.size();
  state.volume.assign(count, 1 / static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    state.velocity.push_back({std::sin(2 * std::numbers::pi * state.sites.y[i]), 0});
  }
  auto fluid = Fluid::begin(session, state, options);
  ASSERT_TRUE(fluid);
  moving::Parcels parcels = moving::parcelsOf(fluid->state(), options.domain);
  MovingCells cells(session, moving::cellsOf(options));
  ASSERT_TRUE(cells.update(parcels.sites));
  const moving::Friction friction(cells, parcels, options, 1);
  const auto sums = [&] {
    Point momentum{0, 0};
    double energy = 0;
    for (const Point& v : parcels.velocity) {
      momentum = {momentum.x + v.x, momentum.y + v.y};
      energy += v.x * v.x + v.y * v.y;
    }
    return std::pair(momentum, energy);
  };
  const auto [momentum, energy] = sums();
  const auto act = [&](double time) {
    EXPECT_GT(friction.act(time, parcels.velocity, [] { return true; }), 0u);
  };
  for (int step = 0; step < 20; ++step) act(0.05);
  const auto [after, left] = sums();
  EXPECT_NEAR(after.x, momentum.x, 1e-7);
  EXPECT_NEAR(after.y, momentum.y, 1e-7);
  const double theory = 8 * std::numbers::pi * std::numbers::pi * options.viscosity;
  EXPECT_NEAR(std::log(energy / left) / theory, 1, 0.01);
  // Any time is as stable: what is left is the mean.
  act(1e9);
  for (const Point& v : parcels.velocity) {
    EXPECT_NEAR(v.x, momentum.x / static_cast<double>(count), 1e-6);
    EXPECT_NEAR(v.y, 0, 1e-6);
  }
}

/// A disc with a square hole that turns.
Outline ringShaped() {
  Outline outline;
  constexpr int corners = 48;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    outline.points.push_back({0.45 * std::cos(angle), 0.45 * std::sin(angle)});
  }
  for (const Point corner : {Point{0.1, 0.1}, {0.1, -0.1}, {-0.1, -0.1}, {-0.1, 0.1}}) {
    outline.points.push_back(corner);
  }
  outline.ring_offsets = {0, corners, corners + 4};
  outline.polygon_offsets = {0, 2};
  return outline;
}

TEST(Fluid, StaysInItsOutline) {
  Session session = test::cpuSession();
  for (const auto scheme : {FluidScheme::projection, FluidScheme::springs}) {
    for (const double viscosity : {0.0, 0.002}) {
      auto setup = fluidCase(FluidCase::gresho, 200, ringShaped());
      ASSERT_TRUE(setup) << setup.error().message;
      setup->options.scheme = scheme;
      setup->options.viscosity = viscosity;
      const Ran ran = runSteps(session, *setup);
      EXPECT_EQ(ran.last.time, 1);
      EXPECT_LE(ran.worst, 1e-6);
      EXPECT_FALSE(ran.last.velocity_error);
      for (std::size_t i = 0; i < ran.state.sites.size(); ++i) {
        const double x = ran.state.sites.x[i], y = ran.state.sites.y[i];
        EXPECT_LE(std::hypot(x, y), 0.45 + 1e-9);
        EXPECT_GE(std::max(std::abs(x), std::abs(y)), 0.1 - 1e-9);
      }
      EXPECT_LE(ran.last.energy(), ran.first.energy() * 1.01);
      if (viscosity > 0) {
        EXPECT_LE(ran.last.kinetic, 0.95 * ran.first.kinetic);
      }
    }
  }
}

TEST(Fluid, RefusesOutlinesThatDoNotFit) {
  Session session = test::cpuSession();
  const auto message = [](FluidCase which, Outline outline) {
    return fluidCase(which, 200, std::move(outline)).error().message;
  };
  EXPECT_THAT(message(FluidCase::shear, ringShaped()),
              HasSubstr("this case repeats itself, in a box of its own"));
  EXPECT_THAT(message(FluidCase::dam_break, ringShaped()),
              HasSubstr("this case has a free surface, in a box of its own"));
  EXPECT_THAT(message(FluidCase::taylor_green, ringShaped()),
              HasSubstr("reaches beyond the domain of the case, 0,0,1,1"));
  FluidSetup setup = *fluidCase(FluidCase::gresho, 100, ringShaped());
  setup.state.sites.x[3] = setup.state.sites.y[3] = 0.01;
  EXPECT_THAT(Fluid::begin(session, setup.state, setup.options).error().message, HasSubstr("sites: 1 of "));
}

TEST(Fluid, RefusesFrictionThatIsNone) {
  Session session = test::cpuSession();
  const auto message = [&](FluidCase which, double viscosity, FluidWalls walls) {
    FluidSetup setup = fluidCase(which, 32);
    setup.options.viscosity = viscosity;
    setup.options.walls = walls;
    return Fluid::begin(session, setup.state, setup.options).error().message;
  };
  EXPECT_EQ(message(FluidCase::gresho, -1, FluidWalls::slip), "viscosity: it is not from 0 to 1e+50");
  EXPECT_EQ(message(FluidCase::gresho, 0, FluidWalls::no_slip),
            "walls: without viscosity a fluid does not stick to them");
  EXPECT_EQ(message(FluidCase::dam_break, 1, FluidWalls::no_slip),
            "walls: a fluid with a free surface slides along them");
}

TEST(Fluid, NamesSitesAtOnePlace) {
  Session session = test::cpuSession();
  FluidSetup setup = fluidCase(FluidCase::shear, 16);
  setup.state.sites.x[3] = setup.state.sites.x[7] + 1;
  setup.state.sites.y[3] = setup.state.sites.y[7];
  EXPECT_THAT(Fluid::begin(session, setup.state, setup.options).error().message,
              HasSubstr("sites 3 and 7 (counted from 0) are at one place"));
}

}  // namespace
}  // namespace vorpipe
