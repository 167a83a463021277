/// The Delaunay triangulation of points, whatever their position.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/big_vector.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// A triangle's corners, counter-clockwise, and the triangles beyond the edges that face them. One corner of
/// triangles outside the hull is `ghost`.
struct MeshTriangle {
  std::array<std::int32_t, 3> corner;
  std::array<std::int32_t, 3> neighbor;
};

/// Stands for a point at infinity: a mesh closes over the hull.
inline constexpr std::int32_t ghost = -1;

struct Mesh {
  BigVector<MeshTriangle> triangles;
  std::vector<std::int32_t>
      at;  ///< by point: a triangle with that corner, or of a hidden point that it is in
};

/// Triangulates distinct points, by weight if there are weights (a regular triangulation), with exact
/// decisions; of points on a circle, an order of insertion that follows from their number alone decides. A
/// point whose cell has no area is hidden.
/// Empty if all lie on a line. Points near each other in the plane should be near each other in the order:
/// then insertions are fast, and most can be done on several threads at once. The mesh does not depend on
/// their number. Coordinates: as predicates.h says, or up to 2^300, if their differences are not below 2^-136
/// then.
Mesh delaunay(std::vector<Point> points, std::vector<double> weights = {}, int threads = 1);

}  // namespace vorpipe::core
