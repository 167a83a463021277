/// Cells in ascending order of their number of edges.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "cells/neighbor_rows.h"

namespace vorpipe::core {

/// Calls each(cell) for cellAt(begin) to cellAt(end - 1), those with few edges first. In this order the
/// branches that end loops over edges are predicted, and cells of equal size can be handled in one vectorized
/// batch.
template <class CellAt, class Each>
void forCellsBySize(const NeighborRows& cells, std::size_t begin, std::size_t end, const CellAt& cellAt,
                    const Each& each) {
  constexpr std::size_t most = 64;
  const auto sizeOf = [&](std::uint32_t cell) {
    return std::min<std::size_t>(cells.edges(cell).size(), most);
  };
  std::array<std::uint32_t, most + 2> next{};
  for (auto k = begin; k < end; ++k) ++next[sizeOf(cellAt(k)) + 1];
  for (std::size_t size = 0; size < most; ++size) next[size + 1] += next[size];
  std::vector<std::uint32_t> order(end - begin);
  for (auto k = begin; k < end; ++k) order[next[sizeOf(cellAt(k))]++] = cellAt(k);
  for (const auto cell : order) each(cell);
}

}  // namespace vorpipe::core
