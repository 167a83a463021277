/// Where a grid is too coarse for its sites.
#pragma once

#include "sites/grid.h"

namespace vorpipe::core {

struct Crowds {
  std::vector<std::uint32_t> even;     ///< sites whose cells a walk over the grid finds fast, ascending
  std::vector<std::uint32_t> crowded;  ///< the others, ascending
};

/// Sorts the sites `which` (ascending) by how many stand in the 3 x 3 bins around them. If many of them are
/// crowded, counts all as crowded: their triangulation is then made anyway, and including the rest costs
/// little.
Crowds sortByCrowds(const Grid& grid, std::span<const std::uint32_t> which, int threads);

}  // namespace vorpipe::core
