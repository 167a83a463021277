/// Pairs the two entries of each edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

inline constexpr std::uint32_t no_twin = ~std::uint32_t{0};

/// The entry of the vertex at which an edge of a cell ends: the next one of its ring.
std::uint64_t nextEntry(const Diagram& diagram, const Cell& cell, std::uint64_t entry);

/// Returns, by entry, the neighbor's entry for the same edge, or no_twin for an edge at a wall. Two cells
/// share one edge, in a periodic domain one for each shift. Along an outline they may share several; the
/// vertices at their ends (`vertex_of`, by entry) distinguish these. Error (input): two cells do not list the
/// same edges with each other.
Result<std::vector<std::uint32_t>> findTwins(const Diagram& diagram, std::span<const std::uint32_t> vertex_of,
                                             int threads);

}  // namespace vorpipe::core
