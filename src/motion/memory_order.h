/// Sites in an order in which neighbors are near each other in memory.
#pragma once

#include <cstdint>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::moving {

/// For each place in the order the index of its site: row by row of squares with about two sites each, in a
/// square by index. Diagrams of sites in this order take less time, since what is read and written of
/// neighboring cells shares cache lines.
std::vector<std::uint32_t> memoryOrder(const Sites& sites, const Box& domain);

/// The sites in that order.
Sites inOrder(const Sites& sites, const std::vector<std::uint32_t>& order);

/// Puts sites in that order back into the caller's, in `to`, which has as many.
void backFrom(const std::vector<std::uint32_t>& order, const Sites& sites, Sites& to);

}  // namespace vorpipe::moving
