/// CellNeighbors from lists of nearest neighbors, as in the thesis.
#pragma once

#include "core/search/neighbor_search.h"

namespace vorpipe::core {

/// Finds the cells of `which` (ascending) on the backend from their nearest neighbors by FLANN: twice as many
/// for those that other sites might still cut, as long as that certifies at least half of them
/// or the lists are short. Adds what is
/// certified; returns the other cells, ascending.
Result<std::vector<std::uint32_t>> findByLists(const SearchInput& input, std::span<const std::uint32_t> which,
                                               NeighborRows& rows, Report& report);

}  // namespace vorpipe::core
