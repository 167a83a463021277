/// What of cells lies in an outline by their own corners, before ties join these (decision D119).
#pragma once

#include "domain/clipped_records.h"

namespace vorpipe::core {

/// The cells of a run that an outline cuts, as polygons of their own corners; places are scaled.
struct OwnParts {
  std::vector<std::uint32_t> cells;  ///< of the set, ascending
  std::vector<ClippedCell> parts;    ///< of each of them

  /// Null where the cell is whole, or none is left of it.
  [[nodiscard]] const ClippedCell* of(std::uint32_t cell) const {
    const auto found = std::ranges::lower_bound(cells, cell);
    if (found == cells.end() || *found != cell) return nullptr;
    return &parts[static_cast<std::size_t>(found - cells.begin())];
  }
};

/// Measures the cells `near` of the set, ascending, to which the outline may come near, by their own corners:
/// writes areas, centroids and second moments over those in `diagram`. Of other cells these are those in the
/// box. `clipped` says what became of the polygons whose corners ties joined. A cell of which only these have
/// nothing inside is `ok` after all.
OwnParts measureOwnParts(const ClippedRun& run, const OutlineIndex& index, const ClippedCells& clipped,
                         std::span<const std::uint32_t> near, Diagram& diagram);

}  // namespace vorpipe::core
