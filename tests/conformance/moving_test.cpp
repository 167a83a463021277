/// Cells of sites that move: the same as those of one run, again and again; and what is solved over them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conformance/cells_fixture.h"
#include "support/sites/data_sets.h"
#include "vorpipe/fluid.h"

namespace vorpipe::test {
namespace {

class Moving : public Cells {
 protected:
  /// Where the sites are after a step of Lloyd's.
  static void moveToCentroids(const CellMoments& moments, Sites& sites) {
    for (std::size_t i = 0; i < sites.size(); ++i) {
      sites.x[i] = moments.centroid[i].x;
      sites.y[i] = moments.centroid[i].y;
    }
  }

  static void expectMoments(const CellMoments& moments, const Diagram& whole, double largest) {
    EXPECT_EQ(moments.status, whole.status);
    ASSERT_EQ(moments.spread.size(), whole.size());
    if (!whole.ring_starts.empty() || !whole.mass.empty()) return expectNearly(moments, whole);
    EXPECT_EQ(moments.area, whole.area);
    EXPECT_EQ(moments.mass, whole.area);
    EXPECT_EQ(moments.centroid, whole.centroid);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const double spread = whole.second_moments[i][0] + whole.second_moments[i][2];
      EXPECT_NEAR(moments.spread[i], spread, 1e-9 * spread + 1e-14 * largest) << "site " << i;
    }
  }

  /// Those of one run are of polygons, whose corners are rounded.
  static void expectNearly(const CellMoments& moments, const Diagram& whole) {
    const auto& masses = whole.mass.empty() ? whole.area : whole.mass;
    const auto& centers = whole.mass.empty() ? whole.centroid : whole.mass_centroid;
    ASSERT_EQ(moments.mass.size(), whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_NEAR(moments.area[i], whole.area[i], 1e-11 * whole.area[i]) << "site " << i;
      EXPECT_NEAR(moments.mass[i], masses[i], 1e-11 * masses[i]) << "site " << i;
      EXPECT_NEAR(moments.centroid[i].x, centers[i].x, 1e-11) << "site " << i;
      EXPECT_NEAR(moments.centroid[i].y, centers[i].y, 1e-11) << "site " << i;
    }
  }

  static void expectSameWhereverTheyGo(Sites sites, CellsOptions wanted) {
    Session& session = sharedSession(GetParam());
    wanted.detail = Detail::polygons;
    MovingCells moving(session, wanted);
    const double width = wanted.domain.xmax - wanted.domain.xmin;
    for (int step = 0; step < 3; ++step) {
      SCOPED_TRACE(testing::Message() << "step " << step);
      const auto updated = moving.update(sites);
      ASSERT_TRUE(updated) << updated.error().message;
      EXPECT_EQ(moving.report().validation_messages, std::vector<std::string>{});
      const Diagram whole = cells(session, sites, wanted);
      expectMoments(moving.moments(), whole, std::pow(width, 4));
      EXPECT_EQ(moving.report().ok, whole.report.ok);
      EXPECT_EQ(moving.report().empty, whole.report.empty);
      EXPECT_EQ(moving.report().duplicate, whole.report.duplicate);
      EXPECT_EQ(moving.neighbors().offsets, whole.cell_offsets);
      EXPECT_EQ(moving.neighbors().neighbors, whole.neighbors);
      EXPECT_EQ(moving.neighbors().shifts, whole.neighbor_shifts);
      moveToCentroids(moving.moments(), sites);
    }
  }
};

TEST_P(Moving, haveTheCellsOfOneRun) {
  for (const char* name : {"random", "clusters", "square", "walls", "cropped"}) {
    SCOPED_TRACE(name);
    const auto set = makeDataSet(name, 700, 5);
    expectSameWhereverTheyGo(set.sites, within(set.domain));
  }
}

TEST_P(Moving, mayHaveWeightsAndDuplicates) {
  Sites sites = generate(Pattern::random, 500, 8);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites.weight.push_back(1e-3 * std::sin(static_cast<double>(i)));
  }
  expectSameWhereverTheyGo(sites, within(unit));
  sites.weight.clear();
  sites.x[7] = sites.x[300];
  sites.y[7] = sites.y[300];
  expectSameWhereverTheyGo(sites, within(unit));
}

TEST_P(Moving, mayHavePeriodsOutlinesAndDensities) {
  const Sites sites = generate(Pattern::random, 400, 9);
  CellsOptions periodic = within(unit);
  periodic.periodic = Periodic::xy;
  expectSameWhereverTheyGo(sites, periodic);
  CellsOptions outlined = within(unit);
  outlined.outline = {{{0.1, 0.1}, {0.9, 0.2}, {0.5, 0.5}, {0.2, 0.9}}, {0, 4}, {0, 1}};
  expectSameWhereverTheyGo(sites, outlined);
  CellsOptions dense = within(unit);
  dense.density = {2, 2, {1, 2, 3, 0.5}};
  expectSameWhereverTheyGo(sites, dense);
}

TEST_P(Moving, endWhereASiteHasNoCell) {
  MovingCells moving(sharedSession(GetParam()), within(unit));
  const auto has = [&](const Sites& sites) {
    const auto updated = moving.updateUnlessEmpty(sites);
    EXPECT_TRUE(updated) << updated.error().message;
    return *updated;
  };
  Sites sites = generate(Pattern::jitter, 3000, 4);
  EXPECT_TRUE(has(sites));
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites.weight.push_back(1e-6 * std::sin(static_cast<double>(i)));
  }
  for (const std::size_t hidden : {0U, 1234U, 2915U}) {
    Sites with_hidden = sites;
    with_hidden.weight[hidden] = -0.01;
    EXPECT_FALSE(has(with_hidden)) << "site " << hidden;
    EXPECT_TRUE(has(sites));
    EXPECT_EQ(moving.moments().area, cells(sharedSession(GetParam()), sites, within(unit)).area);
  }
  Sites beyond = sites;
  beyond.x[9] = 7;
  EXPECT_FALSE(has(beyond));
  beyond.weight.clear();
  EXPECT_FALSE(has(beyond));
  Sites twice = sites;
  twice.x[5] = twice.x[800];
  twice.y[5] = twice.y[800];
  EXPECT_FALSE(has(twice));
  EXPECT_TRUE(has(sites));
  EXPECT_EQ(moving.report().validation_messages, std::vector<std::string>{});
}

TEST_P(Moving, refuseOtherSitesAndStayUsable) {
  MovingCells moving(sharedSession(GetParam()), within(unit));
  const Sites sites = generate(Pattern::random, 50, 3);
  ASSERT_TRUE(moving.update(sites));
  const auto more = moving.update(generate(Pattern::random, 51, 3));
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().code, ErrorCode::input);
  Sites broken = sites;
  broken.x[4] = NAN;
  const auto refused = moving.update(broken);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("site 4 is not finite"));
  const auto again = moving.update(sites);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(moving.moments().area, cells(sites, within(unit)).area);
}

/// What moves sites and masses over cells of a backend: the same as over those of `cpu` with one thread.
class Solvers : public Cells {
 protected:
  static Session& reference() {
    return Shared<Session>::get("cpu with one thread", [] {
      BackendOptions chosen = backend("cpu");
      chosen.threads = 1;
      return open(chosen);
    });
  }

  static TransportOptions inUnitSquare() {
    TransportOptions options{};
    options.domain = unit;
    return options;
  }

  /// Half of the square, in equal parts.
  static TransportOptions halfFull(std::size_t count) {
    TransportOptions options = inUnitSquare();
    options.surface = Surface::free;
    options.masses.assign(count, 0.5 / static_cast<double>(count));
    return options;
  }

  static void expectSameTransport(const Sites& sites, const TransportOptions& options) {
    const auto expected = transport(reference(), sites, options);
    ASSERT_TRUE(expected) << expected.error().message;
    ASSERT_EQ(expected->end, TransportEnd::converged);
    const auto found = transport(sharedSession(GetParam()), sites, options);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->report.validation_messages, std::vector<std::string>{});
    EXPECT_EQ(found->end, expected->end);
    EXPECT_EQ(found->trace.size(), expected->trace.size());
    EXPECT_EQ(found->sites.weight, expected->sites.weight);
    EXPECT_EQ(found->cells.mass, expected->cells.mass);
    EXPECT_EQ(found->cells.centroid, expected->cells.centroid);
    const double each = 1 / static_cast<double>(sites.size());
    for (std::size_t i = 0; i < sites.size() && options.masses.empty() && options.density.values.empty(); ++i)
      EXPECT_NEAR(found->cells.mass[i], each, options.tolerance * each) << "site " << i;
  }

  static double farthest(const std::vector<double>& a, const std::vector<double>& b) {
    double most = a.size() == b.size() ? 0 : INFINITY;
    for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
  }

  /// Lattices begin with corners where four cells meet, whose places may differ by rounding; by no more.
  static void expectSameFlow(const FluidSetup& setup, int steps, double rounding) {
    auto expected = Fluid::begin(reference(), setup.state, setup.options);
    ASSERT_TRUE(expected) << expected.error().message;
    auto found = Fluid::begin(sharedSession(GetParam()), setup.state, setup.options);
    ASSERT_TRUE(found) << found.error().message;
    for (int k = 0; k < steps; ++k) {
      const auto more = expected->step(), found_more = found->step();
      ASSERT_TRUE(more && *more && found_more && *found_more);
      EXPECT_EQ(found->last().halvings, 0U);
      EXPECT_LE(found->last().worst, setup.options.tolerance);
      EXPECT_NEAR(found->last().energy(), expected->last().energy(), rounding) << "step " << k;
    }
    EXPECT_EQ(found->report().validation_messages, std::vector<std::string>{});
    EXPECT_LE(farthest(found->state().sites.x, expected->state().sites.x), rounding);
    EXPECT_LE(farthest(found->state().sites.y, expected->state().sites.y), rounding);
    EXPECT_LE(farthest(found->state().sites.weight, expected->state().sites.weight), rounding);
  }

  static void expectSameFlow(FluidCase which, std::uint64_t parcels, FluidScheme scheme, int steps) {
    SCOPED_TRACE(testing::Message() << "case " << static_cast<int>(which));
    FluidSetup setup = fluidCase(which, parcels);
    setup.options.scheme = scheme;
    expectSameFlow(setup, steps, 1e-11);
  }
};

TEST_P(Solvers, findTheSameWeights) {
  expectSameTransport(generate(Pattern::random, 2000, 21), inUnitSquare());
  TransportOptions dense = inUnitSquare();
  dense.density = {4, 3, {1, 2, 3, 1, 0.5, 2, 1, 4, 2, 2, 1, 1}};
  expectSameTransport(generate(Pattern::random, 500, 24), dense);
}

TEST_P(Solvers, findTheSameWeightsWithPeriodsAndAir) {
  const Sites sites = generate(Pattern::random, 500, 22);
  TransportOptions periodic = inUnitSquare();
  periodic.periodic = Periodic::xy;
  expectSameTransport(sites, periodic);
  expectSameTransport(sites, halfFull(sites.size()));
}

TEST_P(Solvers, makeTheSameSteps) {
  expectSameFlow(FluidCase::taylor_green, 400, FluidScheme::projection, 5);
  expectSameFlow(FluidCase::dam_break, 400, FluidScheme::springs, 8);
  expectSameFlow(FluidCase::shear, 300, FluidScheme::springs, 3);
  FluidSetup stirred = fluidCase(FluidCase::taylor_green, 300);
  stirred.options.scheme = FluidScheme::springs;
  stirred.state = {};
  stirred.state.sites = generate(Pattern::jitter, 300, 23);
  for (std::size_t i = 0; i < stirred.state.sites.size(); ++i) {
    stirred.state.velocity.push_back({std::sin(static_cast<double>(i)), std::cos(static_cast<double>(i))});
  }
  expectSameFlow(stirred, 4, 0);
}

INSTANTIATE_TEST_SUITE_P(Backends, Solvers, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

INSTANTIATE_TEST_SUITE_P(Backends, Moving, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test
