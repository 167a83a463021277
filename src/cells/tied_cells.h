/// Cells at ties, and their vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "cells/cell_check.h"
#include "cells/cell_record.h"

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
  /// By edge of tied cell k: the entries of `tie`, and of `vertex` where it begins.
  [[nodiscard]] std::span<const std::uint8_t> ties(std::size_t k) const {
    return std::span(tie).subspan(offsets[k], offsets[k + 1] - offsets[k]);
  }
  [[nodiscard]] std::span<const std::uint32_t> vertices(std::size_t k) const {
    return std::span(vertex).subspan(offsets[k], offsets[k + 1] - offsets[k]);
  }
  /// The tied cells of a vertex.
  [[nodiscard]] std::span<const std::uint32_t> cellsAt(std::size_t v) const {
    return std::span(around).subspan(around_offsets[v], around_offsets[v + 1] - around_offsets[v]);
  }
};

/// Tied cells per range of a parallel loop.
inline constexpr std::size_t tied_grain = 1024;

/// Calls work(k) for each tied cell k, on several threads, in ranges of tied_grain.
template <class Work>
void forTiedCells(const TiedCells& tied, int threads, const Work& work) {
  parallelEach(tied.cell.size(), tied_grain, threads, [&](std::size_t k) { work(k); });
}

/// Stores in `edges` the indices of those edges of tied cell k that are not ties, beginning with the smallest
/// neighbor's. Corners that begin ties are omitted, so each vertex appears once, with the edge that it
/// begins.
void keptEdges(const ProposedCells& proposed, const TiedCells& tied, std::size_t k,
               std::vector<std::uint32_t>& edges);

/// The position where edge e of tied cell k begins.
inline const AnchoredPoint& tiedPosition(const TiedCells& tied, std::size_t k, std::size_t e) {
  return tied.position[tied.vertex[tied.offsets[k] + e]];
}

/// Measures a tied cell with its own corners, before ties join these: joining moves a vertex by up to a tie,
/// which may be long relative to a thin cell.
Measures recordMeasures(const SiteSet& sites, std::uint32_t cell, std::size_t edges,
                        std::span<const AnchoredPoint> corners, const Records& records);

/// Completes the records of the tied cells with the number of edges that ties leave. None of the cells is
/// disputed.
void recordTiedCells(const ProposedCells& proposed, const TiedCells& tied, const Records& records);

}  // namespace vorpipe::core
