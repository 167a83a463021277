/// The grid over the sites: where its bins lie, and which site is in which.
#pragma once

#include <algorithm>
#include <utility>

#include "backend/backend.h"

namespace vorpipe::core {

/// At this density the walk over the grid is fastest.
inline constexpr double sites_per_bin = 2;

/// Lays square bins over `box`, which may be a segment or a point, about one for every two of the
/// `count` sites in it. The grid's `offsets` are left empty.
Grid layGrid(const Box& box, std::size_t count);

/// The column of x, or the row of y: `low` is the grid's xmin or ymin, `bins` its columns or rows. Points
/// beyond the grid belong to the bins at its border.
inline std::uint32_t binAlong(double coordinate, double low, double size, std::uint32_t bins) {
  const double place = (coordinate - low) / size;
  return place > 0 ? static_cast<std::uint32_t>(std::min(place, static_cast<double>(bins - 1))) : 0u;
}

inline std::uint32_t binOf(const Grid& grid, double x, double y) {
  return binAlong(y, grid.ymin, grid.size, grid.rows) * grid.columns +
         binAlong(x, grid.xmin, grid.size, grid.columns);
}

/// Sites in a rectangle of bins; both bounds of columns and rows are inclusive.
struct BinBlock {
  std::uint32_t west, south, east, north;
};

inline std::uint64_t binsIn(const BinBlock& block) {
  return std::uint64_t{block.east - block.west + 1} * (block.north - block.south + 1);
}

/// A block with `margin` bins more on each side, as far as the grid goes.
inline BinBlock withMargin(const Grid& grid, const BinBlock& block, std::uint32_t margin) {
  return {block.west - std::min(block.west, margin), block.south - std::min(block.south, margin),
          std::min(block.east + margin, grid.columns - 1), std::min(block.north + margin, grid.rows - 1)};
}

/// The two halves of a block of more than one bin, cut across its longer side.
inline std::pair<BinBlock, BinBlock> halves(const BinBlock& block) {
  auto lower = block;
  auto upper = block;
  if (block.east - block.west > block.north - block.south) {
    lower.east = block.west + (block.east - block.west) / 2;
    upper.west = lower.east + 1;
  } else {
    lower.north = block.south + (block.north - block.south) / 2;
    upper.south = lower.north + 1;
  }
  return {lower, upper};
}

/// The number of sites in a block.
std::uint64_t sitesIn(const Grid& grid, const BinBlock& block);

}  // namespace vorpipe::core
