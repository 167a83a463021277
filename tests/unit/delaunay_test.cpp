#include "core/delaunay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "core/predicates.h"

namespace vorpipe::test {
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

/// Says how a mesh is no Delaunay triangulation of the points; empty if it is one.
std::string broken(const std::vector<Point>& points, const std::vector<MeshTriangle>& mesh) {
  std::size_t hull = 0, inside = 0;
  std::set<std::int32_t> used;
  for (std::size_t t = 0; t < mesh.size(); ++t) {
    const auto& c = mesh[t].corner;
    const bool is_outside = std::count(c.begin(), c.end(), beyond) == 1;
    (is_outside ? hull : inside) += 1;
    used.insert(c.begin(), c.end());
    const auto at = [&](std::int32_t i) { return points[static_cast<std::size_t>(i)]; };
    if (!is_outside && orientation(at(c[0]), at(c[1]), at(c[2])) <= 0) return "a triangle is turned";
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& other = mesh[static_cast<std::size_t>(mesh[t].across[k])];
      const auto back = std::find(other.across.begin(), other.across.end(), static_cast<std::int32_t>(t));
      if (back == other.across.end()) return "triangles across an edge do not know each other";
      const auto far = other.corner[static_cast<std::size_t>(back - other.across.begin())];
      if (is_outside || far == beyond) continue;
      if (inCircle(at(c[0]), at(c[1]), at(c[2]), at(far)) > 0) return "an edge should be flipped";
    }
  }
  used.erase(beyond);
  if (used.size() != points.size()) return "a point is missing";
  return inside == 2 * points.size() - 2 - hull ? "" : "Euler's relation does not hold";
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
  EXPECT_TRUE(delaunay(line).empty());
  line.push_back({3, 3.5});
  EXPECT_EQ(broken(line, delaunay(line)), "");
  EXPECT_TRUE(delaunay({}).empty());
  EXPECT_TRUE(delaunay({{1, 2}, {2, 3}}).empty());
}

}  // namespace
}  // namespace vorpipe::test
