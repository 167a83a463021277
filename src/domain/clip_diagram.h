/// The cells of a diagram clipped to an outline.
#pragma once

#include "domain/clipped_records.h"
#include "domain/rings.h"

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

/// Clips cells with polygons to a valid outline, and writes what changes: ring_starts of all cells, and
/// everything else of cells that the outline cuts. A site without a part of the inside becomes `empty`.
/// Measures are those of cells before ties joined their corners, clipped as well; returns the parts of these
/// cells. Two cells are neighbors if each has an edge with the other, between the same two points. Edges that
/// run along the outline belong to it, and so do parts of edges that it makes shorter than ties. Parts of the
/// outline that lie on a wall belong to the wall.
///
/// Errors (input): the outline is too far from the domain; areas that do not add up to the outline's.
Result<OwnParts> clipToOutline(const ClippedRun& run, const Outline& outline, Diagram& diagram);

}  // namespace vorpipe::core
