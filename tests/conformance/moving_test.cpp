/// Cells of sites that move: the same as those of one run, again and again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "conformance/cells_fixture.h"
#include "support/sites/data_sets.h"

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

INSTANTIATE_TEST_SUITE_P(Backends, Moving, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test
