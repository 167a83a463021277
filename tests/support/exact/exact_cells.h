/// Cells in exact arithmetic, by CGAL alone: what every backend is judged by.
#pragma once

#include <cstdint>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::test {

/// What two cells, or a cell and a wall, share inside the domain. An edge that lies in a wall is the wall's.
struct ExactEdge {
  std::int64_t neighbor;
  double length;
  double part;  ///< length by the distance of the two sites; a wall's is that of the mirrored site
};

/// By site: of those with the same position the heaviest, then the first.
std::vector<std::uint32_t> exactOwners(const Sites& sites);

/// Figures are exact but for their last rounding to a double, of at most 1e-12 of themselves.
struct ExactCells {
  std::vector<std::uint32_t> owner;  ///< exactOwners()
  std::vector<std::uint8_t> hidden;  ///< 1 for an owner whose cell would have no area in any domain
  std::vector<double> area;          ///< 0 where a site has no cell
  std::vector<std::uint64_t>
      offsets;                   ///< edges of cell i are offsets[i] .. offsets[i + 1] - 1; size: sites + 1
  std::vector<ExactEdge> edges;  ///< of each cell in ascending order of neighbors, none without length
  std::uint64_t triangles = 0;   ///< of the Delaunay or regular triangulation of those that are not hidden
};

/// The cells of finite sites, by weight if they have weights, clipped to the domain. Takes some 15 us for
/// each site (30 us with weights), and its time is linear in the number of neighbors, however many one cell
/// has.
ExactCells exactCells(const Sites& sites, const Box& domain);

}  // namespace vorpipe::test
