/// The cells of the judge, in double and exact, against brute force in rational numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <set>

#include "backend/cpu/exact_cells.h"
#include "backend/cpu/tree_cells.h"
#include "unit/brute_force.h"

namespace vorpipe::cpu {
namespace {

SiteSet setOf(const std::vector<Point>& points, const Box& domain = {0, 0, 1, 1}) {
  constexpr double far = std::numeric_limits<double>::infinity();
  SiteSet set;
  set.domain = domain;
  set.known = {-far, -far, far, far};
  std::set<std::pair<double, double>> seen;
  for (const auto& p : points) {
    if (!seen.insert({p.x, p.y}).second) continue;
    set.id.push_back(static_cast<std::uint32_t>(set.x.size()));
    set.x.push_back(p.x);
    set.y.push_back(p.y);
  }
  return set;
}

std::vector<std::uint32_t> allOf(const SiteSet& set) {
  std::vector<std::uint32_t> all(set.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

using Finder =
    std::function<void(const SiteSet&, const SiteTree&, std::span<const std::uint32_t>, int, Neighborhoods&)>;

Neighborhoods find(const Finder& finder, const SiteSet& set, int threads = 2) {
  const SiteTree tree(set, threads);
  Neighborhoods out;
  finder(set, tree, allOf(set), threads, out);
  return out;
}

/// Whether the neighbors stand counter-clockwise, as seen from the site.
bool isCounterclockwise(const SiteSet& set, std::uint32_t site, std::span<const std::int32_t> neighbors) {
  int turns = 0;
  const auto direction = [&](std::int32_t n) -> Point {
    if (n >= 0) {
      const auto j = static_cast<std::size_t>(n);
      return {set.x[j] - set.x[site], set.y[j] - set.y[site]};
    }
    return {n == -1 ? -1.0 : n == -2 ? 1.0 : 0.0, n == -3 ? -1.0 : n == -4 ? 1.0 : 0.0};
  };
  double last = std::numeric_limits<double>::infinity();
  for (const auto n : neighbors) {
    const auto d = direction(n);
    const double angle = std::atan2(d.y, d.x);
    turns += angle < last - 1e-9 ? 1 : 0;
    last = angle;
  }
  const auto first = direction(neighbors.front());
  turns += std::atan2(first.y, first.x) < last - 1e-9 ? 1 : 0;
  return turns <= 2;
}

/// Compares every cell that is not open with brute force; returns how many are.
std::size_t compare(const Finder& finder, const SiteSet& set) {
  constexpr double shortest = 1e-12;  // squares
  const auto found = find(finder, set);
  std::size_t open = 0;
  for (std::uint32_t i = 0; i < set.size(); ++i) {
    if (found.status[i] == CellStatus::open) {
      ++open;
      continue;
    }
    const auto edges = edgesByBruteForce(set, i);
    const std::span neighbors(found.neighbor.data() + found.first[i], found.first[i + 1] - found.first[i]);
    std::set<std::int32_t> reported(neighbors.begin(), neighbors.end());
    EXPECT_EQ(reported.size(), neighbors.size()) << "site " << i << " has a neighbor twice";
    std::size_t counting = 0;
    for (const auto& [neighbor, ratio] : edges) {
      counting += ratio > shortest ? 1 : 0;
      // A length may be unsure by a twentieth of the shortest.
      if (ratio > 1.3 * shortest) {
        EXPECT_TRUE(reported.contains(neighbor)) << "site " << i << " lacks " << neighbor;
      }
    }
    for (const auto neighbor : reported) {
      EXPECT_TRUE(edges.contains(neighbor)) << "site " << i << " has " << neighbor << ", which is none";
    }
    if (counting == 0) {
      EXPECT_EQ(found.status[i], CellStatus::empty) << "site " << i;
    } else if (counting >= 3) {
      EXPECT_EQ(found.status[i], CellStatus::certified) << "site " << i;
      EXPECT_TRUE(isCounterclockwise(set, i, neighbors)) << "site " << i;
    }
  }
  return open;
}

void compareBoth(const SiteSet& set, std::size_t most_open) {
  {
    SCOPED_TRACE("in double");
    EXPECT_LE(compare(findInDouble, set), most_open);
  }
  SCOPED_TRACE("exact");
  EXPECT_EQ(compare(findExactly, set), 0U);
}

struct Judge : testing::Test {
  const std::uint64_t seed = std::random_device{}();
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> uniform{0, 1};
  testing::ScopedTrace trace{__FILE__, __LINE__, "seed " + std::to_string(seed)};

  std::vector<Point> points(std::size_t count, const std::function<Point()>& make) {
    std::vector<Point> made;
    for (std::size_t i = 0; i < count; ++i) made.push_back(make());
    return made;
  }
  Point inBox(double x, double y, double size) {
    const double dx = uniform(random);
    return {x + size * dx, y + size * uniform(random)};
  }
};

TEST_F(Judge, whiteNoise) {
  for (const auto count : std::initializer_list<std::size_t>{1, 2, 3, 7, 40, 150}) {
    compareBoth(setOf(points(count, [&] { return inBox(0, 0, 1); })), 0);
  }
}

TEST_F(Judge, crowdedSites) {
  auto sites = points(80, [&] { return inBox(0, 0, 1); });
  for (const double size : {1e-3, 1e-6, 1e-9}) {
    for (const auto& p : points(60, [&] { return inBox(0.3, 0.6, size); })) sites.push_back(p);
  }
  compareBoth(setOf(sites), 4);
}

TEST_F(Judge, sitesOutsideTheDomain) {
  compareBoth(setOf(points(200, [&] { return inBox(-1, -1, 3); })), 0);
  compareBoth(setOf(points(50, [&] { return inBox(4, 4, 3); })), 0);
}

TEST_F(Judge, squareLattice) {
  std::vector<Point> sites;
  for (int i = 0; i < 14; ++i) {
    for (int j = 0; j < 14; ++j) sites.push_back({(i + 0.5) / 14, (j + 0.5) / 14});
  }
  compareBoth(setOf(sites), 0);
}

TEST_F(Judge, squareLatticeThatIsMirroredAtTheWalls) {
  std::vector<Point> sites;
  for (int i = -3; i < 11; ++i) {
    for (int j = -3; j < 11; ++j) sites.push_back({(i + 0.5) / 8, (j + 0.5) / 8});
  }
  compareBoth(setOf(sites), sites.size());
}

TEST_F(Judge, hexagonalLattice) {
  std::vector<Point> sites;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 14; ++j) sites.push_back({(i + (j % 2 == 0 ? 0.25 : 0.75)) / 12, (j + 0.5) / 14});
  }
  compareBoth(setOf(sites), 0);
}

TEST_F(Judge, circleWithAndWithoutItsCenter) {
  std::vector<Point> sites;
  for (int i = 0; i < 70; ++i) {
    const double angle = 2 * M_PI * i / 70;
    sites.push_back({0.5 + 0.4 * std::cos(angle), 0.5 + 0.4 * std::sin(angle)});
  }
  compareBoth(setOf(sites), sites.size());
  sites.push_back({0.5, 0.5});
  compareBoth(setOf(sites), 0);
}

TEST_F(Judge, curves) {
  compareBoth(setOf(points(120,
                           [&] {
                             const double t = uniform(random);
                             return Point{t, 0.5 + 0.2 * std::sin(7 * t)};
                           })),
              20);
  compareBoth(setOf(points(100,
                           [&] {
                             const double t = uniform(random);
                             return Point{t, 0.3 * t + 0.2};
                           })),
              100);
}

TEST_F(Judge, sitesAtTheLimitOfDoubles) {
  std::vector<Point> sites{{0.3, 0.7}, {0.31, 0.2}, {0.9, 0.55}};
  double x = 0.5;
  for (int i = 0; i < 6; ++i) {
    double y = 0.5;
    for (int j = 0; j < 6; ++j) {
      sites.push_back({x, y});
      y = std::nextafter(y, 1.0);
    }
    x = std::nextafter(x, 1.0);
  }
  compareBoth(setOf(sites), sites.size());
  for (auto& p : sites) p = {(p.x - 0.5) * 1e-3, (p.y - 0.5) * 1e-3};
  compareBoth(setOf(sites, {-1, -1, 1, 1}), sites.size());
}

TEST_F(Judge, nearlyCollinearSites) {
  auto sites = points(60, [&] {
    const double t = uniform(random);
    return Point{t, 0.25 + 0.5 * t + 1e-17 * std::round(8 * uniform(random))};
  });
  compareBoth(setOf(sites), sites.size());
  sites = points(60, [&] { return Point{0.5, uniform(random)}; });
  compareBoth(setOf(sites), sites.size());
}

TEST_F(Judge, neighborsOfACellWithVeryMany) {
  constexpr int count = 20000;
  std::vector<Point> sites;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * i / count;
    sites.push_back({0.5 + 0.4 * std::cos(angle), 0.5 + 0.4 * std::sin(angle)});
  }
  sites.push_back({0.5, 0.5});
  const auto set = setOf(sites);
  const auto found = find(findInDouble, set);
  const std::size_t center = count;
  ASSERT_EQ(found.status[center], CellStatus::certified);
  ASSERT_EQ(found.first[center + 1] - found.first[center], static_cast<std::size_t>(count));
  const auto first = found.neighbor[found.first[center]];
  for (int k = 0; k < count; ++k) {
    const auto at = found.first[center] + static_cast<std::size_t>(k);
    ASSERT_EQ(found.neighbor[at], (first + k) % count);
  }
  for (std::uint32_t i = 0; i < 100; ++i) {
    const auto site = static_cast<std::uint32_t>(uniform(random) * count);
    ASSERT_EQ(found.status[site], CellStatus::certified);
    std::set<std::int32_t> neighbors(
        found.neighbor.begin() + static_cast<std::ptrdiff_t>(found.first[site]),
        found.neighbor.begin() + static_cast<std::ptrdiff_t>(found.first[site + 1]));
    EXPECT_TRUE(neighbors.contains(count) &&
                neighbors.contains(static_cast<std::int32_t>((site + 1) % count)));
  }
}

TEST_F(Judge, theSameForAnyNumberOfThreads) {
  auto sites = points(5000, [&] { return inBox(0, 0, 1); });
  for (const auto& p : points(5000, [&] { return inBox(0.2, 0.2, 1e-4); })) sites.push_back(p);
  const auto set = setOf(sites);
  const auto one = find(findInDouble, set, 1);
  for (const int threads : {2, 3}) {
    const auto more = find(findInDouble, set, threads);
    EXPECT_EQ(more.status, one.status);
    EXPECT_EQ(more.first, one.first);
    EXPECT_EQ(more.neighbor, one.neighbor);
  }
}

TEST_F(Judge, saysWhenSitesAreMissingAround) {
  auto set = setOf(points(100, [&] { return inBox(0, 0, 1); }));
  set.domain = {-1, -1, 2, 2};
  set.known = {0, 0, 1, 1};
  const auto found = find(findInDouble, set);
  EXPECT_GT(std::count(found.status.begin(), found.status.end(), CellStatus::unsecured), 5);
  EXPECT_GT(std::count(found.status.begin(), found.status.end(), CellStatus::certified), 5);
}

}  // namespace
}  // namespace vorpipe::cpu
