/// The rings of one cell of a diagram.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace vorpipe::core {

/// Calls take(v, next) with the first and last vertex of each edge of a cell, whose vertices are begin to end
/// - 1. `ring_starts` is that of the diagram.
template <class Take>
void eachEdge(std::span<const std::uint64_t> ring_starts, std::uint64_t begin, std::uint64_t end,
              const Take& take) {
  auto start = std::ranges::upper_bound(ring_starts, begin);
  for (auto ring = begin; ring < end;) {
    const auto next = start != ring_starts.end() ? std::min(*start++, end) : end;
    for (auto v = ring; v < next; ++v) take(v, v + 1 < next ? v + 1 : ring);
    ring = next;
  }
}

}  // namespace vorpipe::core
