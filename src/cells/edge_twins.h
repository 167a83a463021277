/// Which edges of two cells are one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

inline constexpr std::uint32_t no_twin = ~std::uint32_t{0};

/// The entry of the vertex at which an edge of a cell ends: the next one of its ring.
std::uint64_t nextEntry(const Diagram& diagram, const Cell& cell, std::uint64_t entry);

/// By entry: the same edge as the neighbor has it, or no_twin for an edge at a wall. Two cells have one edge
/// in common, in a periodic domain one for each shift; but along an outline there may be several, which are
/// told apart by the positions of their ends: by entry, `vertex_of`. Error (input): two cells do not have the
/// same edges with each other.
Result<std::vector<std::uint32_t>> findTwins(const Diagram& diagram, std::span<const std::uint32_t> vertex_of,
                                             int threads);

}  // namespace vorpipe::core
