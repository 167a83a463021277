#include "geometry/triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "geometry/predicates.h"

namespace vorpipe::test {

using namespace core;

namespace {

TEST(Orientation, isExactOnALine) {
  const Point a{0.1, 0.1}, b{0.3, 0.3};
  EXPECT_EQ(orientation(a, b, {12.7, 12.7}), 0);
  EXPECT_EQ(orientation(a, b, {12.7, std::nextafter(12.7, 13)}), 1);
  EXPECT_EQ(orientation(a, b, {12.7, std::nextafter(12.7, 12)}), -1);
  EXPECT_EQ(orientation({0, 0}, {1e-30, 1}, {2e-30, 2}), 0);
}

TEST(InCircle, isExactOnTheCircle) {
  // Integer points on a circle of radius 5 * 2^-20 about one in the middle of nowhere.
  const auto at = [](double x, double y) { return Point{1 + std::ldexp(x, -20), 1 + std::ldexp(y, -20)}; };
  EXPECT_EQ(inCircle(at(3, 4), at(-4, 3), at(-5, 0), at(3, -4)), 0);
  EXPECT_EQ(inCircle(at(3, 4), at(-4, 3), at(-5, 0), at(0, -5)), 0);
  auto inside = at(0, -5), outside = inside;
  inside.y = std::nextafter(inside.y, 2);
  outside.y = std::nextafter(outside.y, 0);
  EXPECT_EQ(inCircle(at(3, 4), at(-4, 3), at(-5, 0), inside), 1);
  EXPECT_EQ(inCircle(at(3, 4), at(-4, 3), at(-5, 0), outside), -1);
}

TEST(InCircle, breaksTiesByPlacesAlone) {
  const std::vector<Point> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  // The one that is raised most, (1, 1), is outside of the circle of the others, which turns with its
  // triangle.
  EXPECT_EQ(inCirclePerturbed(square[0], square[1], square[3], square[2]), -1);
  EXPECT_EQ(inCirclePerturbed(square[1], square[2], square[3], square[0]), -1);
  EXPECT_EQ(inCirclePerturbed(square[0], square[1], square[2], square[3]), 1);
  EXPECT_EQ(inCirclePerturbed(square[2], square[3], square[0], square[1]), 1);
}

TEST(InCircle, isExactByWeight) {
  const auto at = [](double x, double y, double weight) { return WeightedPoint{{x, y}, weight}; };
  // The powers of (0.5, 0.25) to a, b and c are 0, to d(power) it is `power`.
  const auto a = at(0, 0, 0.3125), b = at(1, 0, 0.3125), c = at(0.5, 1, 0.5625);
  const auto d = [&](double power) { return at(0.25, 0.125, 0.0625 + 0.015625 - power); };
  EXPECT_EQ(inCircle(a, b, c, d(0)), 0);
  EXPECT_EQ(inCircle(a, b, c, d(-0x1p-56)), 1);
  EXPECT_EQ(inCircle(a, b, c, d(0x1p-56)), -1);
  EXPECT_EQ(inInterval(a, at(1, 0, 0.8125), at(0.5, 0, 0.375)), 1);
  EXPECT_EQ(inInterval(a, at(1, 0, 0.8125), at(0.25, 0, 0.25)), 0) << "the powers at 0.25 are -0.25";
  EXPECT_EQ(inInterval(a, at(1, 0, 0.8125), at(0.25, 0, 0.25 - 0x1p-54)), -1);
}

/// Says how a mesh is no Delaunay triangulation of the points, or by weight no regular one; empty if it is
/// one.
std::string broken(const std::vector<Point>& points, const Mesh& made,
                   const std::vector<double>& weights = {}) {
  const auto& mesh = made.triangles;
  const auto weighted = [&](std::int32_t i) {
    const auto k = static_cast<std::size_t>(i);
    return WeightedPoint{points[k], weights.empty() ? 0 : weights[k]};
  };
  std::size_t hull = 0, inside = 0;
  std::set<std::int32_t> used;
  for (std::size_t t = 0; t < mesh.size(); ++t) {
    const auto& c = mesh[t].corner;
    const bool is_outside = std::count(c.begin(), c.end(), ghost) == 1;
    (is_outside ? hull : inside) += 1;
    used.insert(c.begin(), c.end());
    const auto at = [&](std::int32_t i) { return points[static_cast<std::size_t>(i)]; };
    if (!is_outside && orientation(at(c[0]), at(c[1]), at(c[2])) <= 0) return "a triangle is turned";
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& other = mesh[static_cast<std::size_t>(mesh[t].neighbor[k])];
      const auto back = std::find(other.neighbor.begin(), other.neighbor.end(), static_cast<std::int32_t>(t));
      if (back == other.neighbor.end()) return "triangles across an edge do not know each other";
      const auto far = other.corner[static_cast<std::size_t>(back - other.neighbor.begin())];
      if (is_outside || far == ghost) continue;
      if (inCircle(weighted(c[0]), weighted(c[1]), weighted(c[2]), weighted(far)) > 0) {
        return "an edge should be flipped";
      }
    }
  }
  used.erase(ghost);
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(points.size()); ++i) {
    const auto& c = mesh[static_cast<std::size_t>(made.at[static_cast<std::size_t>(i)])].corner;
    if (used.contains(i) != (std::count(c.begin(), c.end(), i) == 1))
      return "a point has a triangle elsewhere";
    if (used.contains(i)) continue;
    const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(c[k % 3])]; };
    for (std::size_t k = 0; k < 3; ++k) {
      const auto p = points[static_cast<std::size_t>(i)];
      if (orientation(at(k), at(k + 1), p) < 0) return "a hidden point lies elsewhere";
    }
    if (inCircle(weighted(c[0]), weighted(c[1]), weighted(c[2]), weighted(i)) > 0)
      return "a point is missing";
  }
  return inside == 2 * used.size() - 2 - hull ? "" : "Euler's relation does not hold";
}

TEST(Delaunay, ofRandomPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const std::size_t count : {3u, 4u, 10u, 2000u}) {
    std::vector<Point> points(count);
    for (auto& p : points) p = {unit(random), unit(random)};
    EXPECT_EQ(broken(points, delaunay(points)), "") << count;
  }
}

TEST(Delaunay, byWeight) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double most : {1e-5, 1e-3, 0.1, 10.0}) {
    std::vector<Point> points(2000), lattice;
    std::vector<double> weights(2000), steps(900);
    for (auto& p : points) p = {unit(random), unit(random)};
    for (auto& weight : weights) weight = most * unit(random);
    EXPECT_EQ(broken(points, delaunay(points, weights), weights), "") << most;
    for (int i = 0; i < 900; ++i) lattice.push_back({i % 30 / 8.0, i / 30 / 8.0});
    for (auto& weight : steps) weight = std::floor(100 * most * unit(random)) / 64;
    EXPECT_EQ(broken(lattice, delaunay(lattice, steps), steps), "") << most;
    // All on the plane through the first three, or nearly so, as inCircle lifts points.
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] = {std::floor(1024 * points[i].x) / 1024,
                   std::floor(1024 * points[i].y) / 1024 + 0x1p-12 * static_cast<double>(i % 4)};
      weights[i] = points[i].x * points[i].x + points[i].y * points[i].y +
                   (i % 2 == 0 ? 1e-14 * most * unit(random) : 0);
    }
    std::set<std::pair<double, double>> seen;
    std::vector<Point> distinct;
    std::vector<double> flat;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!seen.emplace(points[i].x, points[i].y).second) continue;
      distinct.push_back(points[i]);
      flat.push_back(weights[i]);
    }
    EXPECT_EQ(broken(distinct, delaunay(distinct, flat), flat), "") << most;
  }
  std::vector<Point> line;
  for (int i = 0; i < 50; ++i) line.push_back({1.0 * i, 0});
  std::vector<double> heavy(50, 0);
  heavy[20] = 1000;
  EXPECT_TRUE(delaunay(line, heavy).triangles.empty());
  line.push_back({3, 2});
  heavy.push_back(0);
  EXPECT_EQ(broken(line, delaunay(line, heavy), heavy), "");
  line.push_back({30, -0.5});
  heavy.push_back(1e6);
  EXPECT_EQ(broken(line, delaunay(line, heavy), heavy), "");
}

/// So that those near each other are near each other in the order.
std::vector<Point> inRows(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), [](Point a, Point b) {
    const double row_a = std::floor(50 * a.y), row_b = std::floor(50 * b.y);
    return row_a != row_b ? row_a < row_b : a.x < b.x;
  });
  return points;
}

/// The triangles of a mesh, each from its least corner on, in order.
using Corners = std::vector<std::array<Point, 3>>;
Corners trianglesOf(const std::vector<Point>& points, const Mesh& mesh) {
  const auto less = [](Point a, Point b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); };
  Corners all;
  for (const auto& t : mesh.triangles) {
    if (std::count(t.corner.begin(), t.corner.end(), ghost) > 0) continue;
    std::array<Point, 3> corners{};
    std::transform(t.corner.begin(), t.corner.end(), corners.begin(),
                   [&](auto c) { return points[static_cast<std::size_t>(c)]; });
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), less), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end(), [&](const auto& s, const auto& t) {
    return std::lexicographical_compare(s.begin(), s.end(), t.begin(), t.end(), less);
  });
  return all;
}

bool areSame(const Corners& a, const Corners& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& s, const auto& t) {
    return std::equal(s.begin(), s.end(), t.begin(),
                      [](Point p, Point q) { return p.x == q.x && p.y == q.y; });
  });
}

/// Points whose triangulation is decided by ties alone.
std::vector<std::vector<Point>> tiedPoints() {
  std::vector<Point> lattice, circle, snapped;
  std::mt19937 random(13);
  std::uniform_int_distribution<int> step(0, 40);
  std::set<std::pair<int, int>> seen;
  for (int i = 0; i < 400; ++i) lattice.push_back({i % 20 / 16.0, i / 20 / 16.0});
  // Integer points on circles about the origin.
  for (int x = -65; x <= 65; ++x) {
    for (int y = -65; y <= 65; ++y) {
      if (x * x + y * y == 65 * 65 || x * x + y * y == 25 * 25) circle.push_back({1.0 * x, 1.0 * y});
    }
  }
  while (snapped.size() < 500) {
    const int x = step(random), y = step(random);
    if (seen.emplace(x, y).second) snapped.push_back({x / 40.0, y / 40.0});
  }
  return {lattice, circle, snapped};
}

/// However they are ordered, and whichever thread inserts them.
TEST(Delaunay, isUniqueWhereAllAreTies) {
  std::mt19937 random(17);
  for (auto points : tiedPoints()) {
    for (const bool weighted : {false, true}) {
      // Equal weights leave every tie; a few heavier ones hide others.
      std::vector<std::pair<Point, double>> sites;
      for (std::size_t i = 0; i < points.size(); ++i) {
        sites.emplace_back(points[i], i % 7 == 0 ? 0.25 : 0.125);
      }
      Corners first;
      for (int run = 0; run < 20; ++run) {
        std::vector<double> weights;
        for (std::size_t i = 0; i < sites.size(); ++i) {
          points[i] = sites[i].first;
          if (weighted) weights.push_back(sites[i].second);
        }
        const auto mesh = delaunay(points, weights);
        EXPECT_EQ(broken(points, mesh, weights), "");
        const auto triangles = trianglesOf(points, mesh);
        if (run == 0) first = triangles;
        EXPECT_TRUE(areSame(triangles, first)) << "run " << run << ", weighted: " << weighted;
        std::shuffle(sites.begin(), sites.end(), random);
      }
    }
  }
}

/// Cells of a subset that has all neighbors of a site are those of the whole.
TEST(Delaunay, ofSomePointsHasTheSameTriangles) {
  for (const auto& points : tiedPoints()) {
    const auto all = trianglesOf(points, delaunay(points));
    std::vector<Point> low;
    std::copy_if(points.begin(), points.end(), std::back_inserter(low), [](Point p) { return p.y <= 0.5; });
    Corners kept;
    for (const auto& t : trianglesOf(low, delaunay(low))) {
      const auto isThere = [&](const auto& u) { return areSame({t}, {u}); };
      if (std::any_of(all.begin(), all.end(), isThere)) kept.push_back(t);
    }
    std::size_t expected = 0;
    for (const auto& t : all) {
      expected += std::all_of(t.begin(), t.end(), [](Point p) { return p.y <= 0.5; }) ? 1u : 0u;
    }
    EXPECT_EQ(kept.size(), expected);
  }
}

TEST(Delaunay, ofManyPointsInParts) {
  constexpr std::size_t count = 40000;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Point> even(count), curves(count), shuffled(count);
  for (auto& p : even) p = {unit(random), unit(random)};
  for (std::size_t i = 0; i < count; ++i) {
    const double t = unit(random);
    curves[i] = i % 2 == 0 ? Point{t, 0.3 * t * t} : Point{t, 0.6 + 0.3 * std::sin(9 * t)};
    shuffled[i] = even[i];
  }
  for (const auto& points : {inRows(even), inRows(curves), shuffled}) {
    const auto mesh = delaunay(points, {}, 1), shared = delaunay(points, {}, 3);
    EXPECT_EQ(broken(points, mesh), "");
    EXPECT_EQ(broken(points, shared), "");
    EXPECT_TRUE(areSame(trianglesOf(points, mesh), trianglesOf(points, shared)));
    // Such as hide few sites, and most of them.
    for (const double most : {1e-5, 1e-3}) {
      std::vector<double> weights(count);
      for (auto& weight : weights) weight = most * unit(random);
      const auto by_weight = delaunay(points, weights, 1);
      const auto shared_by_weight = delaunay(points, weights, 3);
      EXPECT_EQ(broken(points, by_weight, weights), "") << most;
      EXPECT_EQ(broken(points, shared_by_weight, weights), "") << most;
      EXPECT_TRUE(areSame(trianglesOf(points, by_weight), trianglesOf(points, shared_by_weight))) << most;
    }
  }
}

/// Those whose cells would have no area, in whatever order points are inserted.
TEST(Delaunay, hidesPointsOnTheVerge) {
  constexpr int side = 11;
  std::vector<std::pair<int, int>> places;
  for (int i = 0; i < side * side; ++i) places.emplace_back(i % side, i / side);
  std::mt19937 random(7);
  for (int run = 0; run < 20; ++run) {
    std::shuffle(places.begin(), places.end(), random);
    std::vector<Point> points;
    std::vector<double> flat, board;
    for (const auto& [x, y] : places) {
      points.push_back({1.0 * x, 1.0 * y});
      flat.push_back(1.0 * (x * x + y * y));
      board.push_back((x + y) % 2 == 0 ? 0 : -1);
    }
    const auto isHidden = [&](const Mesh& mesh, std::size_t i) {
      const auto& corner = mesh.triangles[static_cast<std::size_t>(mesh.at[i])].corner;
      return std::count(corner.begin(), corner.end(), static_cast<std::int32_t>(i)) == 0;
    };
    const auto corners_alone = delaunay(points, flat);
    const auto even_alone = delaunay(points, board);
    EXPECT_EQ(broken(points, corners_alone, flat), "");
    EXPECT_EQ(broken(points, even_alone, board), "");
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& [x, y] = places[i];
      EXPECT_EQ(isHidden(corners_alone, i), x % (side - 1) != 0 || y % (side - 1) != 0) << x << ", " << y;
      EXPECT_EQ(isHidden(even_alone, i), (x + y) % 2 != 0) << x << ", " << y;
    }
  }
}

TEST(Delaunay, ofPointsThatAreAllTies) {
  std::vector<Point> lattice, ring, line, cross, parabola;
  for (int i = 0; i < 900; ++i) lattice.push_back({0.1 + i % 30, 0.1 + i / 30});
  for (const auto& p : lattice) {
    if (p.x < 1 || p.y < 1 || p.x > 29 || p.y > 29) ring.push_back(p);
  }
  for (int i = 0; i < 100; ++i) {
    line.push_back({0.1 * i, 0.3 * i});
    cross.push_back(i % 2 == 0 ? Point{1.0 * i, 0} : Point{0, 1.0 * i});
    parabola.push_back({1.0 * i, 1.0 * i * i});
  }
  EXPECT_EQ(broken(lattice, delaunay(lattice)), "");
  EXPECT_EQ(broken(ring, delaunay(ring)), "");
  EXPECT_EQ(broken(cross, delaunay(cross)), "");
  EXPECT_EQ(broken(parabola, delaunay(parabola)), "");
  for (auto& p : line) p.y = p.x;
  EXPECT_TRUE(delaunay(line).triangles.empty());
  line.push_back({3, 3.5});
  EXPECT_EQ(broken(line, delaunay(line)), "");
  EXPECT_TRUE(delaunay({}).triangles.empty());
  EXPECT_TRUE(delaunay({{1, 2}, {2, 3}}).triangles.empty());
}

}  // namespace
}  // namespace vorpipe::test
