/// The cells of the judge, in double and exact, against brute force in rational numbers.
#include "unit/backend/cpu/judge_cases.h"

#include <cmath>

namespace vorpipe::cpu {
namespace {

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

// A mirror image's cell is a piece of the wall between the two, which ends on a wall that its own site is on.
TEST_F(Judge, imagesOfSitesOnAWall) {
  compareBoth(setOf({{0, 0}, {0, 2}}), 2);
  compareBoth(setOf({{0, 0.875}, {0, 1.125}}), 2);
  std::vector<Point> sites;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10; ++j) sites.push_back({1.0 * i, 1.0 * j});
  }
  compareBoth(setOf(sites, {0, 0, 5.5, 5.5}), sites.size());
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
  ASSERT_EQ(found.offsets[center + 1] - found.offsets[center], static_cast<std::size_t>(count));
  const auto first = found.neighbor[found.offsets[center]];
  for (int k = 0; k < count; ++k) {
    const auto at = found.offsets[center] + static_cast<std::size_t>(k);
    ASSERT_EQ(found.neighbor[at], (first + k) % count);
  }
  for (std::uint32_t i = 0; i < 100; ++i) {
    const auto site = static_cast<std::uint32_t>(uniform(random) * count);
    ASSERT_EQ(found.status[site], CellStatus::certified);
    std::set<std::int32_t> neighbors(
        found.neighbor.begin() + static_cast<std::ptrdiff_t>(found.offsets[site]),
        found.neighbor.begin() + static_cast<std::ptrdiff_t>(found.offsets[site + 1]));
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
    EXPECT_EQ(more.offsets, one.offsets);
    EXPECT_EQ(more.neighbor, one.neighbor);
  }
}

TEST_F(Judge, saysWhenSitesAreMissingAround) {
  auto set = setOf(points(100, [&] { return inBox(0, 0, 1); }));
  set.domain = {-1, -1, 2, 2};
  set.coverage = {0, 0, 1, 1};
  const auto found = find(findInDouble, set);
  EXPECT_GT(std::count(found.status.begin(), found.status.end(), CellStatus::unsecured), 5);
  EXPECT_GT(std::count(found.status.begin(), found.status.end(), CellStatus::certified), 5);
}

}  // namespace
}  // namespace vorpipe::cpu
