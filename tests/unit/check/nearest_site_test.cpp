/// What the checks ask for nearest sites, against brute force.
#include "check/nearest_site.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "support/sites/unit.h"
#include "vorpipe.h"

namespace vorpipe::test {

using namespace core::checks;
using ::testing::SizeIs;

namespace {

constexpr Point of_circle{0.5, 0.5};

double powerOf(const CheckedSites& run, std::size_t i, Point p) {
  const Point to = p - run.site(i);
  return dot(to, to) - run.weightDifference(i, 0);
}

/// Sites on a circle, as exactly as double has them, around that place.
Sites circleOf(std::size_t count) {
  Sites sites;
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
    sites.x.push_back(of_circle.x + std::cos(angle) / 4);
    sites.y.push_back(of_circle.y + std::sin(angle) / 4);
  }
  return sites;
}

Sites randomSites(std::size_t count, double heaviest, std::mt19937_64& random) {
  std::uniform_real_distribution<double> anywhere(0, 1);
  Sites sites = generate(Pattern::random, count, random());
  for (std::size_t i = 0; i < count && heaviest > 0; ++i) sites.weight.push_back(heaviest * anywhere(random));
  return sites;
}

TEST(CheckNearestSite, IsTheOneOfLeastPower) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> anywhere(0, 1);
  for (const double heaviest : {0.0, 1e-3, 1.0}) {
    const Sites sites = randomSites(500, heaviest, random);
    const CheckedSites run(sites, unit, Periodic::none, 1);
    const NearestSite nearest(run, {});
    for (int k = 0; k < 200; ++k) {
      const Point p{anywhere(random), anywhere(random)};
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < sites.size(); ++i) least = std::min(least, powerOf(run, i, p));
      EXPECT_NEAR(powerOf(run, nearest.at(p), p), least, 1e-14);
    }
  }
}

TEST(CheckNearestSite, KnowsAllThatAreAsNear) {
  const Sites sites = circleOf(300);
  const CheckedSites run(sites, unit, Periodic::none, 1);
  EXPECT_THAT(NearestSite(run, {}).allAt({of_circle.x * run.scale, of_circle.y * run.scale}), SizeIs(300));
}

TEST(CheckNearestSite, TakesAPlaceThatIsNoNumber) {
  const Sites sites = circleOf(300);
  const CheckedSites run(sites, unit, Periodic::none, 1);
  EXPECT_LT(NearestSite(run, {}).at({std::numeric_limits<double>::quiet_NaN(), 0.5}), 300u);
}

/// Most of the nine tiles are too far away to be asked.
TEST(CheckNearestImage, IsTheOneOfLeastPowerInNineTiles) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> anywhere(0, 1);
  for (const double heaviest : {0.0, 1e-3, 1.0}) {
    for (const std::size_t count : {2u, 9u, 100u}) {
      const Sites sites = randomSites(count, heaviest, random);
      const CheckedSites run(sites, unit, Periodic::xy, 1);
      const NearestSite nearest(run, {});
      for (int k = 0; k < 200; ++k) {
        const Point p{anywhere(random), anywhere(random)};
        double least = std::numeric_limits<double>::infinity();
        for (const double x : {-1.0, 0.0, 1.0})
          for (const double y : {-1.0, 0.0, 1.0})
            for (std::size_t i = 0; i < count; ++i)
              least = std::min(least, powerOf(run, i, {p.x + x, p.y + y}));
        const auto powerOfImage = [&](const NearImage& image) {
          return dot(p - image.place, p - image.place) - run.weightDifference(image.site, 0);
        };
        EXPECT_NEAR(powerOfImage(nearestImage(run, nearest, p)), least, 1e-14);
        EXPECT_NEAR(powerOfImage(nearestImages(run, nearest, p).front()), least, 1e-14);
      }
    }
  }
}

/// A check of many such places would take hours.
TEST(CheckNearestSite, CountsWhatLongSearchesVisit) {
  const Sites sites = circleOf(100'000);
  const CheckedSites run(sites, unit, Periodic::none, 1);
  const NearestSite nearest(run, {});
  static_cast<void>(nearest.at(run.site(17)));
  EXPECT_EQ(nearest.visited(), 0u);
  static_cast<void>(nearest.at({of_circle.x * run.scale, of_circle.y * run.scale}));
  const auto once = nearest.visited();
  EXPECT_GT(once, sites.size() / 16);
  static_cast<void>(nearest.allAt({of_circle.x * run.scale, of_circle.y * run.scale}));
  EXPECT_EQ(nearest.visited(), 2 * once);
}

}  // namespace

}  // namespace vorpipe::test
