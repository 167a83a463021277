/// Where the sites of a run lie: their scale, the grid over them, and which site is in which bin.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "backend/site_set.h"
#include "base/inside.h"

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

inline constexpr double farthest_site = 0x1p300;  ///< in domains

/// Scaled coordinates, of sites and of the domain's walls, are multiples of 2^-200: exact decisions multiply
/// four differences, and a double could not hold the product of smaller ones. All doubles from 2^-148 on are
/// such multiples; values nearer to 0 are rounded to a multiple of 2^-199. Sites that become equal by this
/// would be too near to each other anyway.
inline constexpr double least_coordinate = 0x1p-200;
inline double usableCoordinate(double scaled) {
  constexpr double coarse = 0x1.8p-147;  // adding it rounds off the digits below 2^-199
  return std::abs(scaled) < 0x1p-148 ? (scaled + coarse) - coarse : scaled;
}

/// A domain in scaled units.
Box scaledDomain(const Box& domain, int exponent);

/// The results of one pass over sites, in scaled units.
struct Extent {
  Box box{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  std::size_t inside = 0;  ///< sites within the box `near`
  bool usable = true;      ///< every coordinate is finite and not too far away

  void add(double x, double y, const Box& near) {
    box = {std::min(box.xmin, x), std::min(box.ymin, y), std::max(box.xmax, x), std::max(box.ymax, y)};
    inside += isInside(near, x, y) ? 1U : 0U;
    usable = usable && std::abs(x) <= farthest_site && std::abs(y) <= farthest_site;
  }
  void add(const Extent& other) {
    const auto& b = other.box;
    box = {std::min(box.xmin, b.xmin), std::min(box.ymin, b.ymin), std::max(box.xmax, b.xmax),
           std::max(box.ymax, b.ymax)};
    inside += other.inside;
    usable = usable && other.usable;
  }
};

/// The power of two that brings the domain's longer side into [1, 2).
int scaleExponent(const Box& domain);

/// Error (input): the domain is not a rectangle.
Result<void> checkDomain(const Box& domain);

/// The domain and as much again on every side: farther sites bound few cells, and would make the bins
/// of the others large.
Box surroundings(const Box& domain);

/// The grid over sites of this extent, which was computed with `near`, the surroundings of the domain.
Grid gridOver(const Extent& extent, const Box& near);

/// The error for site i, whose coordinates (x, y) are not finite or too far away.
Error unusableSite(std::size_t i, double x, double y);

}  // namespace vorpipe::core
