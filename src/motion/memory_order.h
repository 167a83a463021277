/// An order of sites in which neighbors are near each other in memory.
#pragma once

#include <cstdint>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::moving {

/// Returns the site index for each place in the order: row by row of squares with about two sites each, and
/// by index in a square. Diagrams of sites in this order take less time, since data of neighboring cells
/// share cache lines.
std::vector<std::uint32_t> memoryOrder(const Sites& sites, const Box& domain);

/// Returns the sites in that order.
Sites inOrder(const Sites& sites, const std::vector<std::uint32_t>& order);

/// Writes sites from that order back in the caller's order to `to`, which has the same size.
void backFrom(const std::vector<std::uint32_t>& order, const Sites& sites, Sites& to);

}  // namespace vorpipe::moving
