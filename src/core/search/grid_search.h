/// CellNeighbors by the search over the grid on a device.
#pragma once

#include "core/search/neighbor_search.h"

namespace vorpipe::core {

/// Finds the cells of `which` (ascending) on the backend, fast, then with more room those that overflow,
/// tile by tile where the sites do not fit. Adds what is certified; returns the other cells, ascending.
Result<std::vector<std::uint32_t>> findByGrid(const SearchInput& input, std::span<const std::uint32_t> which,
                                              NeighborRows& rows, Report& report);

}  // namespace vorpipe::core
