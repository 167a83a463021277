/// Areas, perimeters, centroids and second moments of polygons.
#pragma once

#include <array>
#include <span>

#include "vorpipe.h"

namespace vorpipe::core {

struct Measures {
  double area = 0, perimeter = 0;
  Point centroid{0, 0};                           ///< relative to the vertices' origin
  std::array<double, 3> second_moments{0, 0, 0};  ///< integrals of xx, xy, yy about the centroid
};

/// The integral of the squared distance to the centroid.
inline double spreadOf(const Measures& m) { return m.second_moments[0] + m.second_moments[2]; }

/// The element of a closed ring that follows element k.
template <class Ring>
decltype(auto) nextOf(const Ring& ring, std::size_t k) {
  return ring[k + 1 < ring.size() ? k + 1 : 0];
}

/// Calls take(a, b) for each side of a closed polygon.
template <class Take>
void eachSide(std::span<const Point> ring, const Take& take) {
  for (std::size_t k = 0; k < ring.size(); ++k) take(ring[k], nextOf(ring, k));
}

/// std::hypot, but faster where no square overflows or underflows.
double lengthOf(Point way);

/// Measures a polygon whose vertices run counter-clockwise. For full precision their origin is near it.
/// The centroid of a polygon without area is the mean of its vertices.
Measures measurePolygon(std::span<const Point> vertices);

}  // namespace vorpipe::core
