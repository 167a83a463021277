/// That cells do not depend on what they should not depend on: the backend, the search, threads, the run,
/// and what else is asked for.
#include <gtest/gtest.h>

#include "conformance/cells_fixture.h"
#include "support/oracles/same_bytes.h"
#include "support/sites/data_sets.h"

namespace vorpipe::test {
namespace {

class SameCells : public Cells {};

TEST_P(SameCells, ofAllBackendsAgree) {
  for (const auto pattern : {Pattern::random, Pattern::jitter, Pattern::clusters, Pattern::hex}) {
    const auto sites = generate(pattern, 1500, 21);
    const auto mine = cells(sites, within(unit));
    const auto judge = cells(sharedSession("cpu"), sites, within(unit));
    EXPECT_EQ(mine.status, judge.status);
    EXPECT_EQ(mine.triangles.size(), judge.triangles.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
      EXPECT_EQ(neighborSet(mine, i), neighborSet(judge, i)) << "site " << i;
      EXPECT_NEAR(mine.area[i], judge.area[i], 1e-9 * judge.area[i]) << "site " << i;
    }
  }
}

TEST_P(SameCells, areTheSameBytesInAnyRunWithAnyNumberOfThreads) {
  for (const char* name : {"clusters", "square", "curves", "zip-codes"}) {
    SCOPED_TRACE(name);
    const auto set = makeDataSet(name, 5000, 4);
    const auto first = cells(set.sites, within(set.domain));
    expectSameBytes(first, cells(set.sites, within(set.domain)));
    for (const int threads : {1, 2, 3}) {
      SCOPED_TRACE(testing::Message() << threads << " threads");
      auto chosen = backend(GetParam());
      chosen.threads = threads;
      auto session = open(chosen);
      expectSameBytes(first, cells(session, set.sites, within(set.domain)));
    }
  }
}

TEST_P(SameCells, doNotDependOnTheSearch) {
  const auto sites = generate(Pattern::clusters, 1500, 4);
  const auto grid = cells(sites, within(unit));
  for (const int neighbors : {5, 30}) {
    const auto flann = cells(sites, within(unit, {Search::flann, neighbors}));
    expectTiling(flann, sites, unit);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      EXPECT_EQ(neighborSet(grid, i), neighborSet(flann, i)) << "site " << i;
      EXPECT_NEAR(grid.area[i], flann.area[i], 1e-9 * grid.area[i]) << "site " << i;
    }
  }
}

/// What is not asked for is left out, and what is asked for does not depend on it.
TEST_P(SameCells, haveTheDetailThatIsWanted) {
  for (const char* name : {"random", "hex", "walls", "cropped"}) {
    SCOPED_TRACE(name);
    const auto set = makeDataSet(name, 1000, 6);
    const auto whole = cells(set.sites, within(set.domain));
    auto polygons = cells(set.sites, within(set.domain, {}, Detail::polygons));
    EXPECT_TRUE(polygons.triangles.empty());
    polygons.triangles = whole.triangles;
    expectSameBytes(polygons, whole);
    const auto measures = cells(set.sites, within(set.domain, {}, Detail::measures));
    EXPECT_EQ(measures.status, whole.status);
    EXPECT_EQ(measures.owner, whole.owner);
    EXPECT_EQ(measures.area, whole.area);
    EXPECT_EQ(measures.cell_offsets, whole.cell_offsets);
    EXPECT_EQ(measures.neighbors, whole.neighbors);
    ASSERT_EQ(measures.centroid.size(), whole.centroid.size());
    for (std::size_t i = 0; i < whole.centroid.size(); ++i)
      EXPECT_EQ(place(measures.centroid[i]), place(whole.centroid[i])) << "site " << i;
  }
}

TEST_P(SameCells, tileTheDomainOfEveryDataSet) {
  for (const auto& kind : dataSetKinds()) {
    const auto set = makeDataSet(kind.name, 400, 12);
    SCOPED_TRACE(testing::Message() << set.name << ", seed 12");
    expectTiled(set.sites, set.domain);
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, SameCells, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test
