/// The parts of cells inside an outline by their own corners, before ties join these (decision D119).
#pragma once

#include "domain/clipped_records.h"

namespace vorpipe::core {

/// The cells of a run that an outline cuts, as polygons of their own corners; coordinates are scaled.
struct OwnParts {
  std::vector<std::uint32_t> cells;  ///< of the set, ascending
  std::vector<ClippedCell> parts;    ///< of each of them

  /// Null if the cell is whole, or nothing of it is left.
  [[nodiscard]] const ClippedCell* of(std::uint32_t cell) const {
    const auto found = std::ranges::lower_bound(cells, cell);
    if (found == cells.end() || *found != cell) return nullptr;
    return &parts[static_cast<std::size_t>(found - cells.begin())];
  }
};

/// Measures the cells `near` of the set, ascending, which the outline may come close to, by their own
/// corners. Writes areas, centroids and second moments over those in `diagram`. Other cells keep their
/// measures in the box. `clipped` holds the outcomes for the polygons whose corners ties joined. A cell is
/// `ok` after all if only these polygons have nothing inside.
OwnParts measureOwnParts(const ClippedRun& run, const OutlineIndex& index, const ClippedCells& clipped,
                         std::span<const std::uint32_t> near, Diagram& diagram);

}  // namespace vorpipe::core
