/// Triangles with links to their neighbors.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/big_vector.h"

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
      at;  ///< by point: an incident triangle; for a hidden point, the triangle that contains it
};

}  // namespace vorpipe::core
