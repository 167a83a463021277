/// The Delaunay triangulation of places on a sphere.
#pragma once

#include <array>
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

/// Triangulates sites on the unit sphere. It projects the sphere to a plane from one of the sites
/// (stereographic): circles remain circles, and those through that site become lines. So the triangulation of
/// the others in the plane, and triangles from its hull to that site, are the one on the sphere. With weights
/// it is the projective map that takes this site to infinity, and the plane's sites have weights too
/// (globe.md). Errors: as in Session::cells.
Result<SphereMesh> triangulateSphere(const SphereSites& sites, int threads);

}  // namespace vorpipe::core
