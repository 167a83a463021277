#include "geometry/polygon_measures.h"

#include <algorithm>
#include <cmath>

namespace vorpipe::core {
namespace {

Point meanOf(std::span<const Point> points) {
  const auto count = static_cast<double>(points.size());
  Point mean{0, 0};
  for (const auto& p : points) mean = {mean.x + p.x / count, mean.y + p.y / count};
  return mean;
}

/// Whether a polygon is so thin that its first moments are mostly rounding errors. True for NaN.
bool isSliver(double area, double perimeter) {
  constexpr double share = 1e-10;
  return !(area > share * perimeter * perimeter);
}

/// The centroid of a nearly convex polygon as a weighted mean of the centroids of triangles: weights are not
/// negative, so rounding cannot move it out of the polygon.
Point centroidOfSliver(std::span<const Point> vertices) {
  const Point from = vertices[0];
  Point sum{0, 0};
  double weight = 0;
  for (std::size_t k = 1; k + 1 < vertices.size(); ++k) {
    const Point a{vertices[k].x - from.x, vertices[k].y - from.y};
    const Point b{vertices[k + 1].x - from.x, vertices[k + 1].y - from.y};
    const double area = std::max(a.x * b.y - b.x * a.y, 0.0);
    sum = {sum.x + area * (a.x + b.x), sum.y + area * (a.y + b.y)};
    weight += area;
  }
  if (!(weight > 0)) return meanOf(vertices);
  return {from.x + sum.x / (3 * weight), from.y + sum.y / (3 * weight)};
}

}  // namespace

double lengthOf(Point way) {
  const double squared = way.x * way.x + way.y * way.y;
  return squared > 1e-280 && squared < 1e280 ? std::sqrt(squared) : std::hypot(way.x, way.y);
}

/// Green's theorem, edge by edge (Steger 1996, "On the calculation of arbitrary moments of polygons").
Measures measurePolygon(std::span<const Point> vertices) {
  Measures m;
  if (vertices.empty()) return m;
  double twice_area = 0, xx = 0, xy = 0, yy = 0;
  Point first{0, 0};
  Point a = vertices.back();
  for (const auto b : vertices) {
    const double cross = a.x * b.y - b.x * a.y;
    const Point sum{a.x + b.x, a.y + b.y};
    twice_area += cross;
    m.perimeter += lengthOf({b.x - a.x, b.y - a.y});
    first = {first.x + cross * sum.x, first.y + cross * sum.y};
    xx += cross * (a.x * sum.x + b.x * b.x);
    xy += cross * (sum.x * sum.y + a.x * a.y + b.x * b.y);
    yy += cross * (a.y * sum.y + b.y * b.y);
    a = b;
  }
  m.area = twice_area / 2;
  m.centroid = isSliver(m.area, m.perimeter) ? centroidOfSliver(vertices)
                                             : Point{first.x / (3 * twice_area), first.y / (3 * twice_area)};
  m.second_moments = {xx / 12 - m.area * m.centroid.x * m.centroid.x,
                      xy / 24 - m.area * m.centroid.x * m.centroid.y,
                      yy / 12 - m.area * m.centroid.y * m.centroid.y};
  return m;
}

}  // namespace vorpipe::core
