/// Where a grid is too coarse for its sites (decision D26).
#pragma once

#include "core/sites/grid.h"

namespace vorpipe::core {

/// A rectangle of bins, much of it crowded, that is worth a grid of its own.
struct CrowdedRegion {
  BinBlock block;
  std::vector<std::uint32_t> own;  ///< sites in its crowded bins, ascending
};

struct Crowding {
  std::vector<std::uint32_t> even;  ///< sites whose cells a walk over the grid finds soon, ascending
  std::vector<CrowdedRegion> regions;
  std::vector<std::uint32_t> hopeless;  ///< crowds that are too small for a region, ascending
};

/// Sorts the sites `which` (ascending) by how many stand in the 3 x 3 bins around them. Each is in one of
/// the three.
Crowding sortByCrowding(const Grid& grid, std::span<const std::uint32_t> which, int threads);

}  // namespace vorpipe::core
