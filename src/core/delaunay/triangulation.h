/// The Delaunay triangulation of points in any position, degenerate ones included.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/big_vector.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// A triangle's corners, counter-clockwise, and the neighbors across the opposite edges. A ghost triangle,
/// outside the hull, has one corner `ghost`.
struct MeshTriangle {
  std::array<std::int32_t, 3> corner;
  std::array<std::int32_t, 3> neighbor;
};

/// The ghost vertex, at infinity: with it the mesh is closed over the hull.
inline constexpr std::int32_t ghost = -1;

struct Mesh {
  BigVector<MeshTriangle> triangles;
  std::vector<std::int32_t>
      at;  ///< by point: an incident triangle; for a hidden point, the triangle that it is in
};

/// Triangulates distinct points with exact predicates; with weights it is the regular triangulation. Ties of
/// cocircular points are broken by the order of insertion, which depends on the number of points alone. A
/// point whose cell has no area is hidden.
/// Empty if all lie on a line. Points near each other in the plane should be near each other in the order:
/// then walks are short, and most insertions run on several threads. The mesh does not depend on the number
/// of threads. Coordinates: as in predicates.h; or up to 2^300, then with differences not below
/// 2^-136.
Mesh delaunay(std::vector<Point> points, std::vector<double> weights = {}, int threads = 1);

}  // namespace vorpipe::core
