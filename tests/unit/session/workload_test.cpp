/// What a look at sites says of them.
#include <gtest/gtest.h>

#include <cmath>

#include "support/sites/unit.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

TEST(Lattices, AreSeenBySomeSites) {
  for (const std::size_t count : {100u, 5000u, 200000u}) {
    auto sites = generate(Pattern::square, count, 1);
    EXPECT_TRUE(areOnLattice(sites)) << count;
    EXPECT_TRUE(areOnLattice(generate(Pattern::hex, count, 1))) << count;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const double x = sites.x[i], y = sites.y[i];
      sites.x[i] = 1000 + 300 * (x - y) * std::sqrt(0.5);
      sites.y[i] = -7 + 300 * (x + y) * std::sqrt(0.5);
    }
    EXPECT_TRUE(areOnLattice(sites)) << count << ", turned";
    for (const Pattern pattern : {Pattern::random, Pattern::jitter, Pattern::clusters}) {
      EXPECT_FALSE(areOnLattice(generate(pattern, count, 1))) << count;
    }
  }
}

TEST(Lattices, AreSeenInDigitsThatWereCutOff) {
  auto sites = generate(Pattern::random, 100000, 1);
  for (auto& x : sites.x) x = std::round(1000 * x) / 1000;
  EXPECT_FALSE(areOnLattice(sites)) << "in one direction alone";
  for (auto& y : sites.y) y = std::round(1000 * y) / 1000;
  EXPECT_TRUE(areOnLattice(sites));
}

TEST(Lattices, TakeMoreThanTwoSites) {
  EXPECT_FALSE(areOnLattice({}));
  EXPECT_FALSE(areOnLattice({{0.5, 0.5}, {0.25, 0.75}, {}}));
}

}  // namespace
}  // namespace vorpipe::test
