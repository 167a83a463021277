/// The length of ties around each cell.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "backend/tie.h"

namespace vorpipe::core {

/// How short ties are at each cell. A chain of ties could join vertices that are far apart; there only much
/// shorter edges are ties. An edge is as fine as the finer of its two cells.
class Fineness {
 public:
  /// Each step divides the length of ties by 64; after the last they are as short as rounding errors.
  static constexpr std::uint8_t finest = 5;

  [[nodiscard]] std::uint8_t of(std::size_t cell) const {
    return by_cell_.empty() ? std::uint8_t{0} : by_cell_[cell];
  }
  /// The longest tie between a cell and a neighbor, or a wall, relative to their distance.
  [[nodiscard]] double shortestEdge(std::size_t cell, std::int32_t neighbor) const {
    if (by_cell_.empty()) return shortest_edge;
    const auto there = neighbor < 0 ? std::uint8_t{0} : of(static_cast<std::size_t>(neighbor));
    constexpr int step = 6;
    return std::ldexp(shortest_edge, -step * std::max(of(cell), there));
  }
  /// Makes ties one step finer around these cells; `count` is the number of all cells.
  void increase(const std::vector<std::uint32_t>& cells, std::size_t count) {
    if (by_cell_.empty()) by_cell_.assign(count, 0);
    for (const auto cell : cells) ++by_cell_[cell];
  }

 private:
  std::vector<std::uint8_t> by_cell_;  ///< empty until some cell is finer than others
};

}  // namespace vorpipe::core
