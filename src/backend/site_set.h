/// The sites of a run as backends and searches use them, in the bins of a grid.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// A uniform grid of square bins over sites; shaders/glsl/grid.glsl walks it. Bin (column, row) holds the
/// sites from offsets[row * columns + column] up to the next entry. A site lies in [xmin + column * size,
/// xmin + (column + 1) * size] and in its row likewise, up to rounding in double; a site beyond the grid is
/// in the nearest bin at its border.
struct Grid {
  double xmin = 0, ymin = 0, size = 1;
  std::uint32_t columns = 1, rows = 1;
  std::vector<std::uint32_t> offsets;  ///< size: columns * rows + 1
  /// If sites have weights: the largest weight in each bin without the sites of SiteSet::heavy, or minus
  /// infinity if the bin has no others. The maximum of each 2 x 2 of these numbers follows, and so on up to
  /// one number for the whole grid. Level l has ceil(columns / 2^l) x ceil(rows / 2^l) numbers, row by row.
  /// Sites that a tile does not contain count as well, in the nearest bins at its border.
  std::vector<double> heaviest{};
};

inline constexpr std::size_t most_heavy = 32;

/// Unique sites in scaled units: the input times a power of two, with the domain's longer side in [1, 2).
/// Sites are ordered by the bins of their grid, row by row, and inside a bin by input index.
struct SiteSet {
  std::vector<double> x, y;
  /// Empty if all are equal; otherwise in scaled units squared. The smallest weight of the input is
  /// subtracted where that rounds none of them: only differences matter.
  std::vector<double> weight{};
  std::vector<std::uint32_t> id;  ///< index in the input
  Box domain{};                   ///< what cells are clipped to
  /// The shorter side of a periodic domain; `domain` adds a band of images around it.
  double shorter_side = std::numeric_limits<double>::infinity();
  bool has_images = false;  ///< whether it contains images of the sites of a periodic domain
  Box coverage{};           ///< the set contains every site in this box; unbounded except for a tile
  /// At most most_heavy sites, heaviest first, that are much heavier than the others. They cut every cell
  /// first, since they would widen the search of many cells. A tile has all of them; those from elsewhere
  /// follow its bins.
  std::vector<std::uint32_t> heavy{};
  /// By site: 1 if it is known to have no cell, which is possible with weights; or empty. Because of
  /// rounding, a place may be as near to such a site as to one with a cell.
  std::vector<std::uint8_t> hidden{};
  Grid grid;
  [[nodiscard]] std::size_t size() const { return x.size(); }
};

}  // namespace vorpipe
