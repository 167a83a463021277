/// Which blocks of cells of the lattice are tiles, and how much around them is looked at with them.
#pragma once

#include <vector>

#include "session/site_cells.h"

namespace vorpipe::core {

struct TileBlock {
  BinBlock own;             ///< cells of the lattice
  BinBlock with;            ///< and those around it
  std::uint64_t sites = 0;  ///< in both
};

/// Cuts the lattice into tiles of at most `usual` sites with those around them, or of one cell; those without
/// sites are left out. Tiles have as many sites as each other, not the same area.
std::vector<TileBlock> tilesOf(const SiteCells& cells, std::uint64_t usual);

}  // namespace vorpipe::core
