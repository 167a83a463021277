/// Areas, perimeters, centroids and second moments of polygons.
#pragma once

#include <array>
#include <span>

#include "vorpipe.h"

namespace vorpipe::core {

struct Measures {
  double area = 0, perimeter = 0;
  Point centroid{0, 0};                           ///< relative to where the vertices are
  std::array<double, 3> second_moments{0, 0, 0};  ///< integrals of xx, xy, yy about the centroid
};

/// As std::hypot, but fast where no square overflows or vanishes.
double lengthOf(Point way);

/// Measures a polygon whose vertices run counter-clockwise. For full precision they are relative to a
/// point near it. A polygon without area has its centroid in the mean of its vertices.
Measures measurePolygon(std::span<const Point> vertices);

}  // namespace vorpipe::core
