#include "core/tiles/dense_regions.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <random>

#include "core/sites/site_set.h"
#include "core/tiles/refine.h"
#include "unit/fixtures/all_of.h"

namespace vorpipe::test {

using namespace core;

namespace {

/// Spread sites, and more in a square of the given side.
SiteSet withCluster(std::size_t spread, std::size_t dense, double side) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  Sites sites;
  for (std::size_t i = 0; i < spread + dense; ++i) {
    const double scale = i < spread ? 1 : side;
    const double low = i < spread ? 0 : 0.3;
    sites.x.push_back(low + scale * uniform(random));
    sites.y.push_back(low + scale * uniform(random));
  }
  return prepare(sites, {0, 0, 1, 1}, 1)->set;
}

void expectEachOnce(const Crowding& crowding, const std::vector<std::uint32_t>& which) {
  auto all = crowding.even;
  all.insert(all.end(), crowding.hopeless.begin(), crowding.hopeless.end());
  for (const auto& region : crowding.regions) {
    EXPECT_TRUE(std::is_sorted(region.own.begin(), region.own.end()));
    all.insert(all.end(), region.own.begin(), region.own.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, which);
}

TEST(Crowding, EvenSitesNeedNoFinerGrid) {
  const auto sites = prepare(generate(Pattern::random, 20000, 1), {0, 0, 1, 1}, 1)->set;
  const auto crowding = sortByCrowding(sites.grid, allOf(sites), 2);
  EXPECT_EQ(crowding.even, allOf(sites));
  EXPECT_TRUE(crowding.regions.empty());
}

TEST(Crowding, EverySiteIsSortedOnce) {
  for (const double side : {0.2, 1e-2, 1e-9}) {
    const auto sites = withCluster(5000, 20000, side);
    auto which = allOf(sites);
    expectEachOnce(sortByCrowding(sites.grid, which, 3), which);
    std::erase_if(which, [](std::uint32_t i) { return i % 3 == 0; });
    expectEachOnce(sortByCrowding(sites.grid, which, 3), which);
  }
}

TEST(Crowding, AClusterIsARegion) {
  const auto sites = withCluster(5000, 20000, 1e-2);
  const auto crowding = sortByCrowding(sites.grid, allOf(sites), 1);
  ASSERT_EQ(crowding.regions.size(), 1u);
  EXPECT_NEAR(static_cast<double>(crowding.regions[0].own.size()), 20000, 100);
}

TEST(Crowding, ASmallCrowdIsLeft) {
  const auto few = withCluster(20000, 200, 1e-9);
  EXPECT_EQ(sortByCrowding(few.grid, allOf(few), 1).even.size(), few.size());
}

TEST(Refine, GivesTheRegionBinsOfItsOwn) {
  const auto sites = withCluster(5000, 20000, 1e-2);
  const auto crowding = sortByCrowding(sites.grid, allOf(sites), 1);
  ASSERT_EQ(crowding.regions.size(), 1u);
  const auto& region = crowding.regions[0];
  const auto refined = refine(sites, region, 1);
  const auto& set = refined.sites;
  EXPECT_LT(set.grid.size, sites.grid.size / 20);
  ASSERT_EQ(refined.own.size(), region.own.size());
  ASSERT_EQ(refined.whole.size(), set.size());
  std::vector<std::uint32_t> own;
  for (const auto i : refined.own) own.push_back(refined.whole[i]);
  std::sort(own.begin(), own.end());
  EXPECT_EQ(own, region.own);
  for (std::uint32_t bin = 0; bin + 1 < set.grid.offsets.size(); ++bin) {
    for (auto i = set.grid.offsets[bin]; i < set.grid.offsets[bin + 1]; ++i) {
      ASSERT_EQ(binOf(set.grid, set.x[i], set.y[i]), bin);
      ASSERT_EQ(set.x[i], sites.x[refined.whole[i]]);
      ASSERT_EQ(set.y[i], sites.y[refined.whole[i]]);
      ASSERT_EQ(set.id[i], sites.id[refined.whole[i]]);
    }
  }
}

TEST(Refine, KnowsAllSitesThatItSaysItKnows) {
  const auto sites = withCluster(5000, 20000, 1e-2);
  const auto crowding = sortByCrowding(sites.grid, allOf(sites), 1);
  ASSERT_EQ(crowding.regions.size(), 1u);
  const auto refined = refine(sites, crowding.regions[0], 1);
  const auto& coverage = refined.sites.coverage;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    inside += sites.x[i] > coverage.xmin && sites.x[i] < coverage.xmax && sites.y[i] > coverage.ymin &&
                      sites.y[i] < coverage.ymax
                  ? 1u
                  : 0u;
  }
  EXPECT_EQ(refined.sites.size(), inside);
  EXPECT_LT(coverage.xmax - coverage.xmin, 0.2);
}

}  // namespace
}  // namespace vorpipe::test
