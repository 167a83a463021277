/// Whose cells may share an edge, by CGAL's triangulations.
#pragma once

#include <cstdint>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::test {

/// An edge of the triangulation as seen from one of its sites: `to`, and the third sites of the triangles to
/// the left and right of the way there. Without a triangle, the third site is no_site.
struct Spoke {
  std::uint32_t to, left, right;
};

struct ExactNeighbors {
  std::vector<std::vector<Spoke>> of;  ///< by site
  std::vector<std::uint8_t>
      hidden;  ///< by site: 1 if its cell, were the domain the plane, would have no area
  std::uint64_t triangles = 0;
};

/// The Delaunay triangulation of finite sites, or with weights the regular one without hidden sites; of those
/// sites that own themselves.
ExactNeighbors exactNeighbors(const Sites& sites, const std::vector<std::uint32_t>& owner);

}  // namespace vorpipe::test
