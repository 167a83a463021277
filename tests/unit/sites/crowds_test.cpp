#include "sites/crowds.h"

#include <gtest/gtest.h>

#include <random>

#include "sites/site_set.h"
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

TEST(Crowds, EvenSitesAreInNone) {
  for (const Pattern pattern : {Pattern::random, Pattern::jitter, Pattern::square, Pattern::hex}) {
    const auto sites = prepare(generate(pattern, 20000, 1), {0, 0, 1, 1}, 1)->set;
    const auto crowds = sortByCrowds(sites.grid, allOf(sites), 2);
    EXPECT_LT(crowds.crowded.size(), sites.size() / 100);
    EXPECT_EQ(crowds.even.size() + crowds.crowded.size(), sites.size());
  }
}

TEST(Crowds, EverySiteIsSortedOnce) {
  for (const double side : {0.2, 1e-2, 1e-9}) {
    const auto sites = withCluster(20000, 5000, side);
    auto which = allOf(sites);
    for (const bool all : {true, false}) {
      if (!all) std::erase_if(which, [](std::uint32_t i) { return i % 3 == 0; });
      const auto crowds = sortByCrowds(sites.grid, which, 3);
      std::vector<std::uint32_t> both;
      std::ranges::merge(crowds.even, crowds.crowded, std::back_inserter(both));
      EXPECT_EQ(both, which);
    }
  }
}

TEST(Crowds, AreWhereManySitesAreInFewBins) {
  const auto sites = withCluster(20000, 500, 1e-3);
  const auto crowds = sortByCrowds(sites.grid, allOf(sites), 1);
  EXPECT_NEAR(static_cast<double>(crowds.crowded.size()), 500, 50);
  std::size_t inside = 0;
  for (const auto i : crowds.crowded)
    inside += std::abs(sites.x[i] - 0.3) < 0.1 && std::abs(sites.y[i] - 0.3) < 0.1;
  EXPECT_GE(inside, 500u);
}

TEST(Crowds, AreAllWhereTheyAreMany) {
  const auto sites = withCluster(10000, 8000, 1e-2);
  const auto crowds = sortByCrowds(sites.grid, allOf(sites), 1);
  EXPECT_TRUE(crowds.even.empty());
  EXPECT_EQ(crowds.crowded, allOf(sites));
}

}  // namespace
}  // namespace vorpipe::test
