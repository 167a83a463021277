/// Cells at ties, and their vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "cells/cell_check.h"

namespace vorpipe::core {

/// Cells at ties, whose vertices do not follow from their own neighbors alone. Corners that ties join are one
/// vertex, with one position. Corner offsets[k] + e is where edge e of cell[k] begins.
struct TiedCells {
  std::vector<std::uint32_t> cell;   ///< ascending
  std::vector<std::uint32_t> entry;  ///< by cell: its index in `cell`, or not_tied; empty without tied cells
  std::vector<std::uint64_t> offsets;   ///< size: tied cells + 1
  std::vector<std::uint32_t> vertex;    ///< of each corner
  std::vector<std::uint8_t> tie;        ///< whether the edge that a corner begins is too short to count
  std::vector<AnchoredPoint> position;  ///< of each vertex
  std::vector<std::uint8_t> walls;      ///< of each vertex; 0: it lies on no wall
  std::vector<std::uint32_t> around_offsets,
      around;  ///< the tied cells of each vertex, repeated if they meet it repeatedly
  std::vector<std::uint32_t> disputed;  ///< cells with a dispute that no tie explains, ascending; if there
                                        ///< are none, all of this is right
  std::vector<std::uint32_t> enclosed;  ///< cells to tie as well because ties enclose them, ascending
  std::vector<std::uint32_t> unsure;    ///< cells that must be exact for all of this to be right, ascending
  std::vector<std::uint32_t> wide;      ///< cells that need finer ties, if all are exact, ascending

  static constexpr std::uint32_t not_tied = ~std::uint32_t{0};

  [[nodiscard]] bool has(std::size_t cell_index) const {
    return !entry.empty() && entry[cell_index] != not_tied;
  }
};

/// Stores in `edges` the indices of those edges of tied cell k that are not ties, beginning with the smallest
/// neighbor's. Corners that begin ties are omitted, so each vertex appears once, with the edge that it
/// begins.
void keptEdges(const ProposedCells& proposed, const TiedCells& tied, std::size_t k,
               std::vector<std::uint32_t>& edges);

/// The position where edge e of tied cell k begins.
inline const AnchoredPoint& tiedPosition(const TiedCells& tied, std::size_t k, std::size_t e) {
  return tied.position[tied.vertex[tied.offsets[k] + e]];
}

}  // namespace vorpipe::core
