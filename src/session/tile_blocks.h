/// Divides the lattice into tiles, and decides how much around each is processed with it.
#pragma once

#include <vector>

#include "session/site_cells.h"

namespace vorpipe::core {

struct TileBlock {
  BinBlock own;             ///< cells of the lattice
  BinBlock with;            ///< and the cells around it
  std::uint64_t sites = 0;  ///< in `with`
};

/// Cuts the lattice into tiles of at most `usual` sites including surroundings, or of one cell. Omits tiles
/// without sites. Tiles have about as many sites as each other, not the same area.
std::vector<TileBlock> tilesOf(const SiteCells& cells, std::uint64_t usual);

}  // namespace vorpipe::core
