#include "core/measure.h"

#include <cmath>

namespace vorpipe {

/// Green's theorem, edge by edge (Steger 1996, "On the calculation of arbitrary moments of polygons").
Measures measurePolygon(std::span<const Point> vertices) {
  Measures m;
  Point mean{0, 0};
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const auto a = vertices[k];
    const auto b = vertices[k + 1 < vertices.size() ? k + 1 : 0];
    const double cross = a.x * b.y - b.x * a.y;
    m.area += cross / 2;
    m.perimeter += std::hypot(b.x - a.x, b.y - a.y);
    m.centroid.x += cross * (a.x + b.x) / 6;
    m.centroid.y += cross * (a.y + b.y) / 6;
    m.second_moments[0] += cross * (a.x * a.x + a.x * b.x + b.x * b.x) / 12;
    m.second_moments[1] += cross * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y) / 24;
    m.second_moments[2] += cross * (a.y * a.y + a.y * b.y + b.y * b.y) / 12;
    mean.x += a.x / static_cast<double>(vertices.size());
    mean.y += a.y / static_cast<double>(vertices.size());
  }
  if (m.area > 0) {
    m.centroid = {m.centroid.x / m.area, m.centroid.y / m.area};
  } else {
    m.centroid = mean;
  }
  m.second_moments[0] -= m.area * m.centroid.x * m.centroid.x;
  m.second_moments[1] -= m.area * m.centroid.x * m.centroid.y;
  m.second_moments[2] -= m.area * m.centroid.y * m.centroid.y;
  return m;
}

}  // namespace vorpipe
