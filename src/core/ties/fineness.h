/// How short ties are around each cell.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "backend/tie.h"

namespace vorpipe::core {

/// Ties in a row could join vertices that are far apart: where they would, ties are what is much shorter. An
/// edge is as fine as the finer of its two cells.
class Fineness {
 public:
  /// Ties are a 64th as long at each step; at the last they are what rounding leaves of nothing.
  static constexpr std::uint8_t finest = 5;

  [[nodiscard]] std::uint8_t of(std::size_t cell) const {
    return by_cell_.empty() ? std::uint8_t{0} : by_cell_[cell];
  }
  /// The part that a tie between a cell and a neighbor, or a wall, is of their distance at most.
  [[nodiscard]] double shortestEdge(std::size_t cell, std::int32_t neighbor) const {
    if (by_cell_.empty()) return shortest_edge;
    const auto there = neighbor < 0 ? std::uint8_t{0} : of(static_cast<std::size_t>(neighbor));
    constexpr int step = 6;
    return std::ldexp(shortest_edge, -step * std::max(of(cell), there));
  }
  /// Takes shorter ties around these cells, of `count` in all.
  void increase(const std::vector<std::uint32_t>& cells, std::size_t count) {
    if (by_cell_.empty()) by_cell_.assign(count, 0);
    for (const auto cell : cells) ++by_cell_[cell];
  }

 private:
  std::vector<std::uint8_t> by_cell_;  ///< empty until some cell is finer than others
};

}  // namespace vorpipe::core
