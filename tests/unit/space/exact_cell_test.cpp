// Cells by exact signs: those of all sites together fulfil what makes them the diagram (C1 to C5).
#include "space/exact_cell.h"
#include "space/exact_signs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "space/place.h"
#include "space/predicates.h"
#include "support/sites/random_sites.h"

namespace vorpipe::space {
namespace {

using test::Random;
using Triple = std::array<Label, 3>;
using Sites = std::vector<Point3>;

constexpr Box3 whole_box{0, 0, 0, 1, 1, 1};

double squaredDistance(const Point3& a, const Point3& b) {
  const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return x * x + y * y + z * z;
}

/// Cut by all others, the nearest first or in order of their indices.
ExactCell cellOf(const Places& places, std::size_t sites, Label site, bool nearest_first = true) {
  std::vector<Label> others(sites);
  std::iota(others.begin(), others.end(), 0);
  others.erase(others.begin() + site);
  if (nearest_first) {
    std::ranges::stable_sort(
        others, {}, [&](Label other) { return squaredDistance(places.sites[site], places.sites[other]); });
  }
  ExactCell cell(places, site);
  for (const Label other : others) cell.cut(other);
  return cell;
}

/// The four labels of a vertex in ascending order, and whether they stand in it by an even permutation.
std::pair<std::array<Label, 4>, bool> whole(Label site, const Triple& t) {
  std::array<Label, 4> labels{site, t[0], t[1], t[2]};
  bool even = true;
  for (std::size_t k = 1; k < 4; ++k) {
    for (std::size_t e = k; e > 0 && labels[e] < labels[e - 1]; --e) {
      std::swap(labels[e], labels[e - 1]);
      even = !even;
    }
  }
  return {labels, even};
}

std::set<Triple> turned(std::span<const Triple> vertices) {
  std::set<Triple> all;
  for (Triple t : vertices) {
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    all.insert(t);
  }
  return all;
}

bool areOpposite(Label a, Label b) {
  return isWallLabel(a) && isWallLabel(b) && axisOf(wallOf(a)) == axisOf(wallOf(b));
}

/// Every vertex turns as it should; every edge has two ends, and neither is cut off by the face beyond the
/// other.
void expectConvex(const Places& places, Label site, std::span<const Triple> vertices) {
  std::map<std::pair<Label, Label>, Label> third;
  for (const auto& [a, b, c] : vertices) {
    ASSERT_EQ(orientation(places, site, a, b, c), 1);
    ASSERT_TRUE(third.emplace(std::pair(a, b), c).second);
    ASSERT_TRUE(third.emplace(std::pair(b, c), a).second);
    ASSERT_TRUE(third.emplace(std::pair(c, a), b).second);
  }
  for (const auto& [edge, c] : third) {
    const auto& [a, b] = edge;
    const auto other = third.find({b, a});
    ASSERT_NE(other, third.end());
    if (!areOpposite(c, other->second)) {
      ASSERT_FALSE(cuts(places, site, a, b, c, other->second));
    }
  }
}

/// Returns the number of vertices.
std::size_t expectDiagram(const Sites& sites, const Box3& box, const std::vector<double>& weights = {}) {
  const Places places{sites.data(), box, weights.empty() ? nullptr : weights.data()};
  std::map<std::array<Label, 4>, std::pair<bool, int>> vertices;
  std::vector<Label> without;
  for (Label i = 0; i < static_cast<Label>(sites.size()); ++i) {
    const ExactCell cell = cellOf(places, sites.size(), i);
    EXPECT_EQ(turned(cell.vertices()), turned(cellOf(places, sites.size(), i, false).vertices()));
    if (cell.empty()) {
      without.push_back(i);
      EXPECT_TRUE(leaveNothing(places, i, cell.emptiedBy())) << i;
    }
    expectConvex(places, i, cell.vertices());
    for (const Triple& t : cell.vertices()) {
      const auto& [labels, even] = whole(i, t);
      auto& [first_even, count] = vertices.emplace(labels, std::pair(even, 0)).first->second;
      EXPECT_EQ(even, first_even) << "cells disagree about the side";
      ++count;
    }
  }
  int corner = 0;
  for (const auto& [labels, cells] : vertices) {
    EXPECT_EQ(cells.second, std::ranges::count_if(labels, [](Label l) { return !isWallLabel(l); }));
    corner += labels[0] == -5 && labels[1] == -3 && labels[2] == -1;
    for (const Label i : without) {
      const auto& [a, b, c, site] = labels;  // the last is no wall
      EXPECT_FALSE(cuts(places, site, a, b, c, i));
    }
  }
  EXPECT_EQ(corner, 1);
  return vertices.size();
}

Sites random(std::size_t count, std::uint64_t seed) {
  Random numbers(seed);
  Sites sites(count);
  for (auto& p : sites) (p.x = numbers.uniform(), p.y = numbers.uniform(), p.z = numbers.uniform());
  return sites;
}

/// A cubic lattice of n^3 sites, or one with more in each cell.
Sites lattice(int n, double step, double first, const Sites& basis = {{0, 0, 0}}) {
  Sites sites;
  for (int k = 0; k < n * n * n; ++k) {
    for (const auto& b : basis) {
      sites.push_back(
          {(k % n + b.x) * step + first, (k / n % n + b.y) * step + first, (k / n / n + b.z) * step + first});
    }
  }
  return sites;
}

Sites noisy(Sites sites, double noise) {
  Random numbers(7);
  for (auto& p : sites) {
    p = {p.x + noise * numbers.normal(), p.y + noise * numbers.normal(), p.z + noise * numbers.normal()};
  }
  return sites;
}

Sites sphere(std::size_t count, std::uint64_t seed) {
  Random numbers(seed);
  Sites sites{{0.5, 0.5, 0.5}};
  while (sites.size() <= count) {
    const double x = numbers.normal(), y = numbers.normal(), z = numbers.normal();
    const double scale = 0.4 / std::sqrt(x * x + y * y + z * z);
    sites.push_back({0.5 + scale * x, 0.5 + scale * y, 0.5 + scale * z});
  }
  return sites;
}

Sites snapped(Sites sites, double scale) {
  for (auto& p : sites) {
    p = {std::floor(p.x * scale) / scale, std::floor(p.y * scale) / scale, std::floor(p.z * scale) / scale};
  }
  std::ranges::sort(sites);
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return sites;
}

const Sites bcc{{0, 0, 0}, {0.5, 0.5, 0.5}};
const Sites fcc{{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};

TEST(ExactCell, OfOneSiteIsTheBox) {
  const Sites sites{{0.1, 0.2, 0.3}};
  EXPECT_EQ(expectDiagram(sites, whole_box), 8U);
  const ExactCell cell({sites.data(), whole_box}, 0);
  EXPECT_NEAR(cell.squaredRadius(), 0.81 + 0.64 + 0.49, 1e-12);
}

TEST(ExactCell, OfFewSites) {
  for (std::size_t count = 2; count <= 5; ++count) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) expectDiagram(random(count, seed), whole_box);
  }
}

TEST(ExactCell, OfRandomSites) {
  expectDiagram(random(100, 1), whole_box);
  expectDiagram(noisy(random(50, 2), 1e-3), {-10, -1, -1, 10, 1, 2});
}

TEST(ExactCell, OfLattices) {
  for (const double noise : {0.0, 1e-16, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3}) {
    expectDiagram(noisy(lattice(4, 0.25, 0.125), noise), whole_box);
    expectDiagram(noisy(lattice(4, 0.1, 0.3), noise), whole_box);
    expectDiagram(noisy(lattice(3, 0.3, 0.15, bcc), noise), whole_box);
    expectDiagram(noisy(lattice(3, 0.25, 0.1, fcc), noise), whole_box);
  }
}

TEST(ExactCell, OfSitesOnWallsEdgesAndCorners) {
  expectDiagram(lattice(3, 0.5, 0), whole_box);
  expectDiagram(lattice(2, 1, 0), whole_box);
  expectDiagram(lattice(3, 0.5, 0, {{0, 0, 0}, {0.25, 0.25, 0.25}}), whole_box);
}

TEST(ExactCell, OfSitesOutside) {
  EXPECT_EQ(
      expectDiagram({{0.25, 0.5, 0.5}, {-0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}, {1.25, 0.5, 0.5}}, whole_box),
      12U);
  EXPECT_EQ(expectDiagram({{3, 0.5, 0.5}}, whole_box), 8U);
  expectDiagram({{3, 0.5, 0.5}, {-1, 0.5, 0.625}, {0.5, 9, 0.5}, {9, 9, 9}}, whole_box);
  auto all = lattice(5, 0.5, -0.5);
  expectDiagram(all, whole_box);
  expectDiagram(random(40, 3), {0.25, 0.25, 0.25, 0.5, 0.75, 0.5});
}

TEST(ExactCell, OfSitesInAPlaneOrOnALine) {
  Sites plane, line, circle;
  for (int k = 0; k < 25; ++k) plane.push_back({(k % 5 + 1) * 0.125, (k / 5 + 1) * 0.125, 0.5});
  for (int k = 1; k < 9; ++k) line.push_back({0.1 * k, 0.5, 0.3});
  for (int k = 0; k < 40; ++k) circle.push_back({0.5 + 0.4 * std::cos(k), 0.5 + 0.4 * std::sin(k), 0.5});
  expectDiagram(plane, whole_box);
  expectDiagram(line, whole_box);
  expectDiagram(circle, whole_box);
  expectDiagram(noisy(plane, 1e-13), whole_box);
}

TEST(ExactCell, OfSitesNearOthers) {
  auto sites = random(20, 4);
  for (int k = 0; k < 20; ++k) {
    const Point3& p = sites[static_cast<std::size_t>(k)];
    sites.push_back({p.x + std::ldexp(1, -20 - k), p.y, p.z - std::ldexp(1, -15 - k)});
  }
  expectDiagram(sites, whole_box);
}

TEST(ExactCell, OfDecimals) {
  expectDiagram(snapped(random(80, 5), 10), whole_box);
  expectDiagram(snapped(random(80, 6), 8), whole_box);
  expectDiagram(snapped(random(80, 7), 1e6), whole_box);
}

TEST(ExactCell, OfWeights) {
  Random numbers(12);
  const auto weightsOf = [&](std::size_t count, const auto& weight) {
    std::vector<double> weights(count);
    for (double& w : weights) w = weight();
    return weights;
  };
  const Sites sites = random(60, 4), exact = lattice(4, 0.25, 0.125), rounded = lattice(4, 0.23, 0.11, bcc);
  const auto moderate = [&] { return 0.05 * numbers.uniform(); };
  const auto decades = [&] { return std::pow(10.0, 6 * numbers.uniform() - 7); };
  const auto few = [&] { return static_cast<double>(numbers.below(4)) / 64; };
  expectDiagram(sites, whole_box, weightsOf(60, moderate));
  expectDiagram(sites, whole_box, weightsOf(60, [&] { return -decades(); }));
  expectDiagram(sites, whole_box, weightsOf(60, decades));
  expectDiagram(exact, whole_box, weightsOf(exact.size(), few));
  expectDiagram(exact, whole_box, weightsOf(exact.size(), [&] { return 4 * few(); }));
  expectDiagram(rounded, whole_box, weightsOf(rounded.size(), few));
  expectDiagram(snapped(random(80, 5), 8), whole_box,
                weightsOf(snapped(random(80, 5), 8).size(), [&] { return few() / 4; }));
  // All but one are hidden; and cells that are one point.
  std::vector<double> one(exact.size(), 0.0);
  one[21] = 100;
  EXPECT_EQ(expectDiagram(exact, whole_box, one), 8U);
  one[21] = 1.0 / 16;
  expectDiagram(exact, whole_box, one);
}

TEST(ExactCell, OfASphereAndItsCenter) {
  expectDiagram(sphere(150, 8), whole_box);
  expectDiagram(snapped(sphere(150, 9), 64), whole_box);
}

TEST(ExactCell, OfManyFaces) {
  const auto sites = sphere(3000, 10);
  const Places places{sites.data(), whole_box};
  for (const bool nearest_first : {true, false}) {
    const ExactCell cell = cellOf(places, sites.size(), 0, nearest_first);
    std::set<Label> faces;
    for (const auto& t : cell.vertices()) faces.insert(t.begin(), t.end());
    EXPECT_EQ(faces.size(), 3000U);
    EXPECT_EQ(cell.vertices().size(), 2 * faces.size() - 4);
    expectConvex(places, 0, cell.vertices());
    EXPECT_NEAR(cell.squaredRadius(), 0.04, 0.01);
  }
}

/// More vertices go at once than come, with more edges than are compared each to each; then new ones come.
TEST(ExactCell, LosesManyVerticesAtOnce) {
  auto sites = sphere(800, 11);
  sites.push_back({0.5, 0.5, 0.5 + 0x1p-40});
  const auto last = static_cast<Label>(sites.size() - 1);
  for (auto p : sphere(400, 12)) {
    p = {0.5 + 0.99 * (p.x - 0.5), 0.5 + 0.99 * (p.y - 0.5), 0.5 + 0.99 * (p.z - 0.5)};
    if (p.z < 0.5) sites.push_back(p);
  }
  const Places places{sites.data(), whole_box};
  ExactCell cell(places, 0);
  for (Label other = 1; other < last; ++other) cell.cut(other);
  const auto before = cell.vertices().size();
  EXPECT_TRUE(cell.cut(last));
  EXPECT_LT(cell.vertices().size(), before * 3 / 4);
  expectConvex(places, 0, cell.vertices());
  for (Label other = last + 1; other < static_cast<Label>(sites.size()); ++other) cell.cut(other);
  expectConvex(places, 0, cell.vertices());
  EXPECT_EQ(turned(cell.vertices()), turned(cellOf(places, sites.size(), 0).vertices()));
}

TEST(ExactCell, IsCutBySiteOnce) {
  const auto sites = lattice(3, 0.25, 0.25);
  const Places places{sites.data(), whole_box};
  ExactCell cell(places, 13);
  for (const bool first : {true, false}) {
    for (const Label other : {4, 10, 12, 14, 16, 22}) EXPECT_EQ(cell.cut(other), first) << other;
  }
}

/// No vertex is farther, and one is about as far, also if places in double are wrong by far: true places are
/// by integers.
void expectRadius(const ExactCell& cell, const Places& places, Label site) {
  double least = 0, most = 0;
  for (const auto& [a, b, c] : cell.vertices()) {
    double error = 0;
    const Point3 p = vertexPlace(places, site, a, b, c, &error);
    const double distance = std::sqrt(squaredDistance(p, {0, 0, 0}));
    const Point3 exact = exactPlace(places, site, {a, b, c});
    least = std::max(least, std::sqrt(squaredDistance(exact, {0, 0, 0})) * (1 - 1e-15));
    most = std::max(most, distance + error);
  }
  EXPECT_GE(cell.squaredRadius(), least * least);
  EXPECT_LE(cell.squaredRadius(), most * most * (1 + 1e-5));
}

TEST(ExactCell, KnowsItsRadius) {
  for (const double noise : {0.0, 1e-15, 1e-10, 1e-5, 1e-1}) {
    auto sites = noisy(lattice(3, 0.25, 0.25), noise);
    for (auto& p : sites) p.z = 0.5 + 1e-3 * p.z;
    const Places places{sites.data(), whole_box};
    for (Label i = 0; i < 27; ++i) {
      ExactCell cell(places, i);
      for (Label other = 0; other < 27; ++other) {
        if (other != i && cell.cut(other)) expectRadius(cell, places, i);
      }
    }
  }
  const auto sites = sphere(400, 13);
  const Places places{sites.data(), whole_box};
  ExactCell cell(places, 0);
  for (Label other = 1; other <= 400; ++other) {
    if (cell.cut(other)) expectRadius(cell, places, 0);
  }
}

// Sites side by side on a sphere meet near its center, far away: where they face no axis, rounding moves that
// by far more than 1e-15.
TEST(ExactCell, KnowsItsRadiusWhereRoundingIsLarge) {
  constexpr double radius = 0.8, step = 1e-4;
  Sites sites;
  for (int x = -3; x <= 3; ++x) {
    for (int y = -3; y <= 3; ++y) {
      const double dx = step * (x + 0.3 * std::sin(y)), dy = step * (y + 0.3 * std::cos(2 * x));
      const double out = std::sqrt(radius * radius - dx * dx - dy * dy);
      sites.push_back({0.1 + 0.6 * out + 0.8 * dx, 0.15 + 0.48 * out - 0.36 * dx + 0.8 * dy,
                       0.1 + 0.64 * out - 0.48 * dx - 0.6 * dy});
    }
  }
  const Places places{sites.data(), whole_box};
  const auto count = static_cast<Label>(sites.size());
  for (Label i = 0; i < count; ++i) {
    ExactCell cell(places, i);
    for (Label other = 0; other < count; ++other) {
      if (other != i) cell.cut(other);
    }
    expectRadius(cell, places, i);
  }
}

}  // namespace
}  // namespace vorpipe::space
