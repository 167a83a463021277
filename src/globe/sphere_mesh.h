/// The Delaunay triangulation of places on a sphere.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh.h"
#include "globe/direction.h"
#include "vorpipe/result.h"

namespace vorpipe::core {

/// Triangles between sites on a sphere, closed around it: no site is inside the circle of one. With weights,
/// the hull of the sites' vectors.
struct SphereMesh {
  std::vector<std::uint32_t> owner;  ///< by site: the site that has the cell of this direction
  std::vector<std::uint32_t> site;   ///< by vertex of the triangles, along a curve
  /// Closed: counter-clockwise seen from outside, each with neighbors on all sides. Empty if all sites lie on
  /// one circle.
  BigVector<MeshTriangle> triangles;
  std::vector<std::int32_t> at;  ///< by vertex: the index of a triangle around it; -1: weights hide the site
  /// Otherwise all sites with cells, counter-clockwise around the circle's axis.
  std::vector<std::uint32_t> circle;
};

/// A triangle's corners from the lowest: the same however the mesh was made.
template <class Number>
std::array<Number, 3> fromLowest(const std::array<Number, 3>& corner) {
  const auto [a, b, c] = corner;
  const std::array twice{a, b, c, a, b};
  // Without jumps, which no processor would foresee.
  const auto first = c < std::min(a, b) ? std::size_t{2} : std::size_t{b < a};
  return {twice[first], twice[first + 1], twice[first + 2]};
}

/// Triangulates sites on the unit sphere. It projects the sphere to a plane from one of the sites
/// (stereographic): circles remain circles, and those through that site become lines. So the triangulation of
/// the others in the plane, and triangles from its hull to that site, are the one on the sphere. With weights
/// it is the projective map that takes this site to infinity, and the plane's sites have weights too
/// (globe.md). Errors: as in Session::cells.
Result<SphereMesh> triangulateSphere(const SphereSites& sites, int threads);

}  // namespace vorpipe::core
