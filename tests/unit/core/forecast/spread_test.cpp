/// What a look at sites says of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/sites/unit.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

constexpr std::size_t enough = 40'000;

TEST(Spread, EvenSitesHaveNeitherTiesNorCrowds) {
  for (const Pattern pattern : {Pattern::random, Pattern::jitter, Pattern::hex}) {
    const Spread spread = spreadOf(generate(pattern, enough, 3), unit, 2);
    EXPECT_EQ(spread.tied, 0) << static_cast<int>(pattern);
    EXPECT_EQ(spread.edges, 6);
    EXPECT_FALSE(spread.uneven);
    EXPECT_FALSE(spread.along_curves);
  }
}

TEST(Spread, AllCellsOfALatticeAreTied) {
  const Spread spread = spreadOf(generate(Pattern::square, enough, 1), unit, 2);
  EXPECT_GT(spread.tied, 0.98);
  EXPECT_NEAR(spread.edges, 4, 0.3);
  EXPECT_FALSE(spread.uneven);
}

TEST(Spread, TurnedMovedAndInAnyOrderALatticeIsOne) {
  Sites sites = generate(Pattern::square, enough, 1);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double x = sites.x[i], y = sites.y[i];
    sites.x[i] = 1000 + 300 * (x - y) * std::sqrt(0.5);
    sites.y[i] = -7 + 300 * (x + y) * std::sqrt(0.5);
  }
  std::mt19937_64 random(2);
  for (std::size_t left = sites.size(); left > 1; --left) {
    const auto other = random() % left;
    std::swap(sites.x[left - 1], sites.x[other]);
    std::swap(sites.y[left - 1], sites.y[other]);
  }
  const auto [xmin, xmax] = std::ranges::minmax(sites.x);
  const auto [ymin, ymax] = std::ranges::minmax(sites.y);
  EXPECT_GT(spreadOf(sites, {xmin, ymin, xmax, ymax}, 2).tied, 0.98);
}

TEST(Spread, OfSomeTiesItSaysHowMany) {
  // Half of the domain is a lattice.
  Sites sites = generate(Pattern::square, enough, 1);
  const Sites other = generate(Pattern::random, enough, 1);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (sites.x[i] > 0.5) sites.x[i] = 0.5 + other.x[i] / 2, sites.y[i] = other.y[i];
  }
  const Spread spread = spreadOf(sites, unit, 2);
  EXPECT_NEAR(spread.tied, 0.5, 0.12);
  EXPECT_EQ(spread.edges, 6);
}

TEST(Spread, ClustersAreUnevenAndNoCurves) {
  const Spread spread = spreadOf(generate(Pattern::clusters, enough, 1), unit, 2);
  EXPECT_TRUE(spread.uneven);
  EXPECT_FALSE(spread.along_curves);
}

TEST(Spread, ACircleIsACurve) {
  EXPECT_TRUE(spreadOf(generate(Pattern::circle, enough, 1), unit, 2).along_curves);
}

TEST(Spread, SitesBeyondTheDomainAreTheJudges) {
  const Spread spread = spreadOf(generate(Pattern::random, enough, 1), {0, 0, 1, 0.9}, 2);
  EXPECT_TRUE(spread.uneven);
  EXPECT_TRUE(spread.along_curves);
  EXPECT_FALSE(spreadOf(generate(Pattern::random, enough, 1), {0, 0, 1, 0.97}, 2).along_curves);
}

TEST(Spread, EqualSitesAndSitesOnALineAreLookedAt) {
  Sites sites;
  sites.x.assign(enough, 0.5);
  sites.y.assign(enough, 0.5);
  EXPECT_TRUE(spreadOf(sites, unit, 2).uneven);
  // Evenly along the only axis that there is, they are no crowd; but their cells reach far.
  for (std::size_t i = 0; i < enough; ++i) sites.x[i] = static_cast<double>(i) / enough;
  const Spread spread = spreadOf(sites, unit, 2);
  EXPECT_TRUE(spread.uneven);
  EXPECT_FALSE(spread.along_curves);
  EXPECT_EQ(spread.tied, 0);
}

TEST(Spread, DoesNotDependOnThreads) {
  const Sites sites = generate(Pattern::clusters, enough, 4);
  const Spread one = spreadOf(sites, unit, 1), several = spreadOf(sites, unit, 4);
  EXPECT_EQ(one.tied, several.tied);
  EXPECT_EQ(one.edges, several.edges);
  EXPECT_EQ(one.uneven, several.uneven);
  EXPECT_EQ(one.along_curves, several.along_curves);
}

TEST(Spread, OfFewSitesNothingIsSaid) {
  EXPECT_EQ(spreadOf(generate(Pattern::square, 100, 1), unit).tied, 0);
  EXPECT_EQ(spreadOf({}, unit).edges, 6);
}

}  // namespace
}  // namespace vorpipe::test
