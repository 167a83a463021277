/// What every diagram of cells is judged by: the promises that it can be asked about without another.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::test {

inline std::set<std::int64_t> neighborSet(const Diagram& d, std::size_t i) {
  return {d.neighbors.begin() + static_cast<std::ptrdiff_t>(d.cell_offsets[i]),
          d.neighbors.begin() + static_cast<std::ptrdiff_t>(d.cell_offsets[i + 1])};
}

using Place = std::pair<double, double>;

inline Place place(const Point& p) { return {p.x, p.y}; }

/// Twice the area of the triangle a, b, c, positive when it runs counter-clockwise.
inline double turn(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// How far a position may be off because of rounding.
inline double rounding(const Box& domain) {
  const double size = std::max(domain.xmax - domain.xmin, domain.ymax - domain.ymin);
  const double far = std::max(
      {std::abs(domain.xmin), std::abs(domain.xmax), std::abs(domain.ymin), std::abs(domain.ymax), size});
  return 1e-12 * size + 1e-15 * far;
}

/// Checks one cell: a closed, convex, counter-clockwise polygon, its walls and its measures.
inline void expectPolygon(const Diagram& d, std::size_t i, const Box& domain) {
  const auto begin = d.cell_offsets[i];
  const auto count = d.cell_offsets[i + 1] - begin;
  // The ends of a long thin cell may be ties, which leaves it two edges.
  ASSERT_GE(count, 2u);
  EXPECT_EQ(neighborSet(d, i).size(), count) << "a neighbor stands twice";
  // Nearly touching cells lose up to a millionth where a tie closes.
  const double slack = rounding(domain) + 1e-6 * d.perimeter[i];
  double perimeter = 0;
  double area = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    const auto a = d.vertices[begin + k];
    const auto b = d.vertices[begin + (k + 1) % count];
    const auto c = d.vertices[begin + (k + 2) % count];
    EXPECT_GE(turn(a, b, c), -slack * std::hypot(c.x - a.x, c.y - a.y)) << "not convex at vertex " << k + 1;
    area += turn(d.vertices[begin], a, b) / 2;
    EXPECT_GT(d.edge_lengths[begin + k], 0);
    EXPECT_NEAR(d.edge_lengths[begin + k], std::hypot(b.x - a.x, b.y - a.y), rounding(domain));
    perimeter += d.edge_lengths[begin + k];
    switch (d.neighbors[begin + k]) {
      case wall_xmin:
        EXPECT_TRUE(a.x == domain.xmin && b.x == domain.xmin && b.y < a.y);
        break;
      case wall_xmax:
        EXPECT_TRUE(a.x == domain.xmax && b.x == domain.xmax && b.y > a.y);
        break;
      case wall_ymin:
        EXPECT_TRUE(a.y == domain.ymin && b.y == domain.ymin && b.x > a.x);
        break;
      case wall_ymax:
        EXPECT_TRUE(a.y == domain.ymax && b.y == domain.ymax && b.x < a.x);
        break;
      default:
        EXPECT_GE(d.neighbors[begin + k], 0);
    }
  }
  EXPECT_TRUE(d.area[i] > 0 || (count == 2 && d.area[i] == 0)) << d.area[i];
  // The area is that of the cell, whose corners ties have not moved.
  EXPECT_NEAR(d.area[i], area, slack * perimeter);
  EXPECT_NEAR(d.perimeter[i], perimeter, 1e-12 * perimeter);
  for (std::uint64_t k = 0; k < count; ++k) {
    const auto a = d.vertices[begin + k];
    const auto b = d.vertices[begin + (k + 1) % count];
    EXPECT_GE(turn(a, b, d.centroid[i]), -slack * d.edge_lengths[begin + k]) << "the centroid is outside";
  }
}

/// Checks that cells share their edges and vertices to the bit, and Euler's formula.
inline void expectSharing(const Diagram& d, const Box& domain) {
  std::map<std::pair<std::int64_t, std::int64_t>, std::uint64_t> edges;
  std::map<Place, int> vertices;
  std::vector<std::uint64_t> next(d.vertices.size());
  for (std::size_t i = 0; i < d.status.size(); ++i) {
    for (auto e = d.cell_offsets[i]; e < d.cell_offsets[i + 1]; ++e) {
      edges[{static_cast<std::int64_t>(i), d.neighbors[e]}] = e;
      ++vertices[place(d.vertices[e])];
      next[e] = e + 1 < d.cell_offsets[i + 1] ? e + 1 : d.cell_offsets[i];
    }
  }
  std::int64_t halves = 0;
  for (const auto& [cells, e] : edges) {
    const auto& [cell, neighbor] = cells;
    halves += neighbor < 0 ? 2 : 1;
    if (neighbor < 0) continue;
    const auto back = edges.find({neighbor, cell});
    ASSERT_NE(back, edges.end()) << "site " << neighbor << " lacks its neighbor " << cell;
    EXPECT_EQ(d.edge_lengths[e], d.edge_lengths[back->second]);
    EXPECT_EQ(place(d.vertices[e]), place(d.vertices[next[back->second]]));
    EXPECT_EQ(place(d.vertices[next[e]]), place(d.vertices[back->second]));
  }
  for (const auto& [p, cells] : vertices) {
    const bool at_x = p.first == domain.xmin || p.first == domain.xmax;
    const bool at_y = p.second == domain.ymin || p.second == domain.ymax;
    EXPECT_GE(cells, at_x && at_y ? 1 : at_x || at_y ? 2 : 3) << "at " << p.first << ", " << p.second;
  }
  const auto faces = static_cast<std::int64_t>(d.report.ok);
  EXPECT_EQ(static_cast<std::int64_t>(vertices.size()) - halves / 2 + faces, 1) << "Euler";
}

/// Checks the promises of a diagram: one record for each site; the cells tile the domain.
inline void expectTiling(const Diagram& d, const Sites& sites, const Box& domain) {
  ASSERT_EQ(d.status.size(), sites.size());
  ASSERT_EQ(d.owner.size(), sites.size());
  ASSERT_EQ(d.cell_offsets.size(), sites.size() + 1);
  ASSERT_EQ(d.vertices.size(), d.cell_offsets.back());
  ASSERT_EQ(d.neighbors.size(), d.cell_offsets.back());
  ASSERT_EQ(d.edge_lengths.size(), d.cell_offsets.back());
  EXPECT_EQ(d.report.ok + d.report.empty + d.report.duplicate, sites.size());
  double sum = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "site " << i);
    sum += d.area[i];
    if (d.status[i] == Status::ok) {
      expectPolygon(d, i, domain);
      continue;
    }
    EXPECT_EQ(d.cell_offsets[i], d.cell_offsets[i + 1]);
    EXPECT_EQ(d.area[i], 0);
    EXPECT_EQ(d.perimeter[i], 0);
    EXPECT_EQ(place(d.centroid[i]), (Place{sites.x[i], sites.y[i]}));
  }
  const double whole = (domain.xmax - domain.xmin) * (domain.ymax - domain.ymin);
  EXPECT_NEAR(sum, whole, 1e-12 * whole);
  expectSharing(d, domain);
}

/// How far p lies inside the circle through the counter-clockwise triangle a, b, c: a determinant,
/// positive inside.
inline double inCircle(Point a, Point b, Point c, Point p) {
  const auto row = [&](Point q) { return Point{q.x - p.x, q.y - p.y}; };
  const auto u = row(a);
  const auto v = row(b);
  const auto w = row(c);
  const auto square = [](Point q) { return q.x * q.x + q.y * q.y; };
  return square(u) * (v.x * w.y - v.y * w.x) - square(v) * (u.x * w.y - u.y * w.x) +
         square(w) * (u.x * v.y - u.y * v.x);
}

/// Checks that the triangles run counter-clockwise, stand once, share edges in opposite directions and
/// have no site inside their circles.
inline void expectDelaunay(const Diagram& d, const Sites& sites) {
  std::set<std::set<std::uint32_t>> seen;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  const auto site = [&](std::uint32_t i) { return Point{sites.x[i], sites.y[i]}; };
  for (const auto& [i, j, k] : d.triangles) {
    EXPECT_TRUE((seen.insert({i, j, k}).second));
    EXPECT_TRUE((edges.insert({i, j}).second && edges.insert({j, k}).second && edges.insert({k, i}).second));
    EXPECT_GT(turn(site(i), site(j), site(k)), 0);
    for (std::uint32_t p = 0; p < sites.size(); ++p) {
      if (p == i || p == j || p == k) continue;
      EXPECT_LE(inCircle(site(i), site(j), site(k), site(p)), 1e-15)
          << p << " is in the circle of " << i << ", " << j << ", " << k;
    }
  }
}

/// The number of sites on the convex hull, none of three in a line.
inline std::size_t hullSize(const Sites& sites) {
  std::vector<Point> sorted;
  for (std::size_t i = 0; i < sites.size(); ++i) sorted.push_back({sites.x[i], sites.y[i]});
  std::sort(sorted.begin(), sorted.end(), [](Point a, Point b) { return place(a) < place(b); });
  const auto chain = [&](double side) {
    std::vector<Point> hull;
    for (const auto p : sorted) {
      while (hull.size() > 1 && side * turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    return hull.size() - 1;
  };
  return chain(1) + chain(-1);
}

}  // namespace vorpipe::test
