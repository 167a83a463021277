/// Nearest sites against brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "backend/cpu/nearest_site.h"

namespace vorpipe::cpu {
namespace {

/// How much nearer (x, y) is to the nearest site that is not hidden than to this one, as a difference of
/// powers.
double missedBy(const SiteSet& set, std::uint32_t site, double x, double y) {
  const auto power = [&](std::size_t i) {
    const double dx = x - set.x[i];
    const double dy = y - set.y[i];
    return dx * dx + dy * dy - (set.weight.empty() ? 0 : set.weight[i]);
  };
  const auto is_hidden = [&](std::size_t i) { return !set.hidden.empty() && set.hidden[i] != 0; };
  EXPECT_FALSE(is_hidden(site));
  double least = power(site);
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (!is_hidden(i)) least = std::min(least, power(i));
  }
  return power(site) - least;
}

/// At the centers of a picture of `side` x `side` pixels.
void compare(const SiteSet& set, double rounding, int side = 40) {
  const NearestSite nearest(set, 2);
  for (int k = 0; k < side * side; ++k) {
    const double x = (k % side + 0.5) / side;
    const double y = (k / side + 0.5) / side;
    EXPECT_LE(missedBy(set, nearest.at({0, 0}, {x, y}), x, y), rounding) << "at " << x << ", " << y;
  }
}

struct Nearest : testing::TestWithParam<double> {
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> uniform{0, 1};

  SiteSet noise(std::size_t count) {
    SiteSet set;
    for (std::size_t i = 0; i < count; ++i) {
      set.id.push_back(static_cast<std::uint32_t>(i));
      set.x.push_back(uniform(random));
      set.y.push_back(uniform(random));
      if (GetParam() > 0) set.weight.push_back(GetParam() * uniform(random));
    }
    return set;
  }
};

TEST_P(Nearest, showsTheNearestSite) {
  for (const std::size_t count : {1U, 2U, 7U, 300U}) compare(noise(count), 1e-14 * (1 + GetParam()));
}

// Pixels in rows, of which most are not searched for.
TEST_P(Nearest, isTheSamePixelAfterPixel) {
  constexpr int side = 250;
  for (const std::size_t count : {1U, 2U, 7U, 300U, 40'000U}) {
    const SiteSet set = noise(count);
    const NearestSite nearest(set, 2);
    NearestSite::Walk walk(nearest, 1.0 / side);
    int wrong = 0;
    for (int k = 0; k < side * side; ++k) {
      const Point p{(k % side + 0.5) / side, (k / side + 0.5) / side};
      wrong += walk.at({0, 0}, p) != nearest.at({0, 0}, p);
    }
    EXPECT_EQ(wrong, 0) << count << " sites";
  }
}

// The center of a square: whatever order the set has them in.
TEST_P(Nearest, showsTheFirstOfSitesThatAreEquallyNear) {
  SiteSet set;
  set.x = {1, 0, 1, 0};
  set.y = {0, 1, 1, 0};
  if (GetParam() > 0) set.weight.assign(4, GetParam());
  set.id = {3, 1, 2, 5};
  EXPECT_EQ(NearestSite(set, 2).at({0, 0}, {0.5, 0.5}), 1U);
  EXPECT_EQ(NearestSite(set, 2).at({0, 0}, {0.5, 0.25}), 0U);
}

// In any order: each part lies among the others.
TEST_P(Nearest, showsTheNearestSiteOfManyParts) { compare(noise(300'000), 1e-14 * (1 + GetParam()), 6); }

// Rows of sites: parts lie above each other, and one of them may have no site that is seen.
TEST_P(Nearest, showsTheNearestSiteOfPartsInRows) {
  auto set = noise(400'000);
  std::sort(set.y.begin(), set.y.end());
  compare(set, 1e-14 * (1 + GetParam()), 6);
  set.hidden.assign(set.size(), 0);
  std::fill_n(set.hidden.begin() + (1 << 17), 1 << 17, std::uint8_t{1});
  compare(set, 1e-14 * (1 + GetParam()), 6);
}

TEST_P(Nearest, showsHeavySites) {
  if (GetParam() == 0) return;
  auto set = noise(200);
  for (std::uint32_t i = 0; i < 5; ++i) {
    set.weight[i] += 0.1;
    set.heavy.push_back(i);
  }
  compare(set, 1e-14 * (1 + GetParam()));
  set.weight[3] = 1e12;
  const NearestSite nearest(set, 2);
  EXPECT_EQ(nearest.at({0, 0}, {0.1, 0.9}), 3U);
}

TEST_P(Nearest, showsHeavySitesAlone) {
  auto set = noise(20);
  if (set.weight.empty()) return;
  set.heavy.resize(20);
  std::iota(set.heavy.begin(), set.heavy.end(), 0U);
  compare(set, 1e-14 * (1 + GetParam()));
}

// As when weights leave each site less than an outline has room for.
TEST_P(Nearest, showsNoSiteWhereAllAreHidden) {
  auto set = noise(20);
  if (set.weight.empty()) return;
  set.heavy = {3, 7};
  set.hidden.assign(20, 1);
  EXPECT_EQ(NearestSite(set, 2).at({0, 0}, {0.1, 0.9}), no_site);
  set.hidden[7] = 0;
  EXPECT_EQ(NearestSite(set, 2).at({0, 0}, {0.1, 0.9}), 7U);
}

INSTANTIATE_TEST_SUITE_P(Weights, Nearest, testing::Values(0.0, 1e-3, 0.1, 100.0));

}  // namespace
}  // namespace vorpipe::cpu
