#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "vorpipe.h"
#include "vorpipe/patterns.h"

namespace vorpipe::test {
namespace {

constexpr Pattern all_patterns[] = {Pattern::random, Pattern::square,   Pattern::hex,
                                    Pattern::jitter, Pattern::clusters, Pattern::circle};

/// FNV-1a over the bits of all coordinates, the lowest byte first.
std::uint64_t hash(const Sites& sites) {
  std::uint64_t result = 0xCBF29CE484222325u;
  for (const auto* coordinates : {&sites.x, &sites.y}) {
    for (const double value : *coordinates) {
      for (int shift = 0; shift < 64; shift += 8) {
        result = (result ^ (std::bit_cast<std::uint64_t>(value) >> shift & 0xFF)) * 0x100000001B3u;
      }
    }
  }
  return result;
}

TEST(Generate, CountsAreRight) {
  for (const std::uint64_t n : {1u, 2u, 3u, 5u, 24u, 25u, 26u, 1000u, 12345u}) {
    for (const Pattern pattern : {Pattern::random, Pattern::jitter, Pattern::clusters, Pattern::circle}) {
      EXPECT_EQ(generate(pattern, n, 1).size(), n);
    }
    const auto side = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(n)));
    EXPECT_EQ(generate(Pattern::square, n, 1).size(), side * side);
    const auto hex = static_cast<double>(generate(Pattern::hex, n, 1).size());
    EXPECT_NEAR(hex, static_cast<double>(n), 1 + 1.5 * std::sqrt(static_cast<double>(n))) << n;
  }
}

TEST(Generate, SitesAreInsideAndDistinct) {
  for (const Pattern pattern : all_patterns) {
    const Sites sites = generate(pattern, 20000, 1);
    ASSERT_EQ(sites.x.size(), sites.y.size());
    EXPECT_TRUE(sites.weight.empty());
    std::set<std::pair<double, double>> distinct;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      ASSERT_GT(std::min(sites.x[i], sites.y[i]), 0);
      ASSERT_LT(std::max(sites.x[i], sites.y[i]), 1);
      distinct.emplace(sites.x[i], sites.y[i]);
    }
    EXPECT_EQ(distinct.size(), sites.size());
  }
}

TEST(Generate, SameSeedSameSites) {
  for (const Pattern pattern : all_patterns) {
    EXPECT_EQ(hash(generate(pattern, 1000, 7)), hash(generate(pattern, 1000, 7)));
  }
  for (const Pattern pattern : {Pattern::random, Pattern::jitter, Pattern::clusters}) {
    EXPECT_NE(hash(generate(pattern, 1000, 7)), hash(generate(pattern, 1000, 8)));
  }
  for (const Pattern pattern : {Pattern::square, Pattern::hex, Pattern::circle}) {
    EXPECT_EQ(hash(generate(pattern, 1000, 7)), hash(generate(pattern, 1000, 8)));
  }
}

// The same on every platform: a difference here changes everybody's pictures.
TEST(Generate, SitesArePinned) {
  EXPECT_EQ(hash(generate(Pattern::random, 1000, 1)), 0xC2DF151A8BBA0C37u);
  EXPECT_EQ(hash(generate(Pattern::square, 1000, 1)), 0xE185569057E5194Du);
  EXPECT_EQ(hash(generate(Pattern::hex, 1000, 1)), 0xE6F21F1FC6B58BB8u);
  EXPECT_EQ(hash(generate(Pattern::jitter, 1000, 1)), 0xAB994F816D7A297Bu);
  EXPECT_EQ(hash(generate(Pattern::clusters, 1000, 1)), 0xA3BB35EFCA35E53Au);
  EXPECT_EQ(hash(generate(Pattern::circle, 1000, 1)), 0xCA66980B6C43B405u);
}

TEST(Generate, SquareIsALatticeRowByRow) {
  const Sites sites = generate(Pattern::square, 10, 1);
  ASSERT_EQ(sites.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(sites.x[i], (static_cast<double>(i % 3) + 0.5) / 3);
    EXPECT_EQ(sites.y[i], (static_cast<double>(i / 3) + 0.5) / 3);
  }
}

TEST(Generate, InnerSitesOfHexHaveSixNearestNeighbors) {
  const Sites sites = generate(Pattern::hex, 500, 1);
  double nearest = 1;
  for (std::size_t j = 1; j < sites.size(); ++j) {
    nearest = std::min(nearest, std::hypot(sites.x[j] - sites.x[0], sites.y[j] - sites.y[0]));
  }
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double margin = 1.5 * nearest;
    if (std::min(sites.x[i], sites.y[i]) < margin || std::max(sites.x[i], sites.y[i]) > 1 - margin) {
      continue;
    }
    int neighbors = 0;
    for (std::size_t j = 0; j < sites.size(); ++j) {
      const double distance = std::hypot(sites.x[j] - sites.x[i], sites.y[j] - sites.y[i]);
      neighbors += j != i && distance < nearest * (1 + 1e-9) ? 1 : 0;
    }
    EXPECT_EQ(neighbors, 6) << i;
  }
}

TEST(Generate, HexFillsTheSquareEvenly) {
  for (const std::uint64_t n : {100u, 1000u, 250000u}) {
    const Sites sites = generate(Pattern::hex, n, 1);
    const double row = std::sqrt(std::sqrt(0.75) / static_cast<double>(n));
    const auto [low, high] = std::minmax_element(sites.y.begin(), sites.y.end());
    EXPECT_NEAR(*low, 1 - *high, 1e-12);
    EXPECT_LT(*low, row);
    EXPECT_LT(*std::min_element(sites.x.begin(), sites.x.end()), row);
  }
}

TEST(Generate, JitterHasOneSitePerSquare) {
  const Sites sites = generate(Pattern::jitter, 90, 3);
  std::set<std::pair<int, int>> squares;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    squares.emplace(static_cast<int>(sites.x[i] * 10), static_cast<int>(sites.y[i] * 10));
  }
  EXPECT_EQ(squares.size(), 90u);
}

TEST(Generate, CircleIsEvenAndSymmetric) {
  for (const std::size_t n : {1u, 3u, 7u, 8u, 1000u, 2001u}) {
    const Sites sites = generate(Pattern::circle, n, 1);
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2 * 3.14159265358979323846 * static_cast<double>(i) / static_cast<double>(n);
      ASSERT_NEAR(sites.x[i], 0.5 + 0.4 * std::cos(angle), 1e-13);
      ASSERT_NEAR(sites.y[i], 0.5 + 0.4 * std::sin(angle), 1e-13);
      if (i > 0) {
        EXPECT_EQ(sites.x[i], sites.x[n - i]);
        EXPECT_EQ(sites.y[i] + sites.y[n - i], 1);
      }
    }
  }
}

TEST(Generate, ClustersAreDense) {
  const Sites sites = generate(Pattern::clusters, 20000, 1);
  std::set<std::pair<int, int>> squares;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    squares.emplace(static_cast<int>(sites.x[i] * 100), static_cast<int>(sites.y[i] * 100));
  }
  EXPECT_LT(squares.size(), 5000u);  // of 10,000; white noise would meet 8,600 of them
}

}  // namespace
TEST(Generate, InTheUnitSquareBoxesMakeNoDifference) {
  for (const Pattern pattern : all_patterns) {
    for (const std::uint64_t n : {1u, 10u, 143u, 1000u}) {
      EXPECT_EQ(hash(generate(pattern, n, 7, {0, 0, 1, 1})), hash(generate(pattern, n, 7)));
    }
  }
}

/// Each quarter of the width and of the height has its part.
TEST(Generate, SitesAreAllOverTheBox) {
  for (const Box& box : {Box{0, 0, 1.5, 1}, Box{-3, 10, -2, 40}, Box{5, 5, 45, 6}}) {
    for (const Pattern pattern : {Pattern::random, Pattern::square, Pattern::hex, Pattern::jitter}) {
      const Sites sites = generate(pattern, 4000, 1, box);
      EXPECT_NEAR(static_cast<double>(sites.size()), 4000, 400);
      std::array<int, 4> across{}, up{};
      for (std::size_t i = 0; i < sites.size(); ++i) {
        const double x = (sites.x[i] - box.xmin) / (box.xmax - box.xmin);
        const double y = (sites.y[i] - box.ymin) / (box.ymax - box.ymin);
        ASSERT_TRUE(x >= 0 && x <= 1 && y >= 0 && y <= 1);
        ++across.at(static_cast<std::size_t>(std::min(3.0, 4 * x)));
        ++up.at(static_cast<std::size_t>(std::min(3.0, 4 * y)));
      }
      for (const auto& parts : {across, up}) {
        EXPECT_GT(*std::ranges::min_element(parts), pattern == Pattern::random ? 900 : 500);
      }
    }
  }
}

TEST(Generate, LatticesHaveEqualSpacingsInABox) {
  const Sites square = generate(Pattern::square, 150, 1, {0, 0, 1.5, 1});
  ASSERT_EQ(square.size(), 150u);
  EXPECT_NEAR(square.x[1] - square.x[0], 0.1, 1e-15);
  EXPECT_NEAR(square.y[15] - square.y[0], 0.1, 1e-15);
  const Sites hex = generate(Pattern::hex, 1000, 1, {0, 0, 3, 1});
  const double side = hex.x[1] - hex.x[0];
  const auto next = static_cast<std::size_t>(std::ranges::count(hex.y, hex.y[0]));
  EXPECT_NEAR(std::hypot(hex.x[next] - hex.x[0], hex.y[next] - hex.y[0]), side, 1e-12);
}

TEST(Generate, TheCircleStaysOne) {
  const Sites sites = generate(Pattern::circle, 50, 1, {0, 0, 4, 2});
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_NEAR(std::hypot(sites.x[i] - 2, sites.y[i] - 1), 0.8, 1e-12);
  }
}

/// Clusters that were as wide as a thin box is long would have next to nothing in it.
TEST(Generate, ThinBoxesAreFilled) {
  for (const Box& box : {Box{0, 0, 1e9, 1e-3}, Box{0, 0, 1e-9, 1}}) {
    for (const Pattern pattern : all_patterns) {
      const Sites sites = generate(pattern, 100, 1, box);
      EXPECT_GE(sites.size(), 50u);
      EXPECT_LE(sites.size(), 200u);
    }
  }
}

}  // namespace vorpipe::test
