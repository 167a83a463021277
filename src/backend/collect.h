/// Finds CellNeighbors on all threads and joins them in order.
#pragma once

#include <algorithm>
#include <numeric>
#include <utility>

#include "backend/backend.h"
#include "base/parallel.h"

namespace vorpipe {

/// Rotates the neighbors of a cell so that the smallest number comes first.
inline void beginAtFirst(std::span<std::int32_t> neighbors) {
  std::rotate(neighbors.begin(), std::min_element(neighbors.begin(), neighbors.end()), neighbors.end());
}

/// Renumbers the sites or lines among the neighbors of entry e.
template <class NumberOf>
void renumber(CellNeighbors& cells, std::size_t e, const NumberOf& numberOf) {
  const auto neighbors =
      std::span(cells.neighbor).subspan(cells.offsets[e], cells.offsets[e + 1] - cells.offsets[e]);
  for (auto& neighbor : neighbors) {
    if (neighbor >= 0) neighbor = static_cast<std::int32_t>(numberOf(static_cast<std::uint32_t>(neighbor)));
  }
  beginAtFirst(neighbors);
}

constexpr std::size_t collect_grain = 1024;

/// Replaces `out` with `count` neighborhoods. Calls make() for every range of entries. It returns a function
/// find(e, neighbors), which appends the neighbors of entry e and returns its status.
template <class Make>
void collect(std::size_t count, int threads, CellNeighbors& out, const Make& make) {
  constexpr std::size_t usual_neighbors = 8;
  std::vector<std::vector<std::int32_t>> found((count + collect_grain - 1) / collect_grain);
  out.status.resize(count);
  out.offsets.resize(count + 1);
  parallelFor(count, collect_grain, threads, [&](std::size_t begin, std::size_t end) {
    auto find = make();
    std::vector<std::int32_t> neighbors;
    neighbors.reserve(usual_neighbors * (end - begin));
    for (auto e = begin; e < end; ++e) {
      out.offsets[e] = neighbors.size();
      out.status[e] = find(e, neighbors);
      beginAtFirst(std::span(neighbors).subspan(out.offsets[e]));
    }
    found[begin / collect_grain] = std::move(neighbors);
  });
  std::vector<std::uint64_t> offset(found.size() + 1, 0);
  for (std::size_t f = 0; f < found.size(); ++f) offset[f + 1] = offset[f] + found[f].size();
  out.offsets[count] = offset.back();
  out.neighbor.resize(offset.back());
  parallelFor(count, collect_grain, threads, [&](std::size_t begin, std::size_t end) {
    const auto range = begin / collect_grain;
    for (auto e = begin; e < end; ++e) out.offsets[e] += offset[range];
    std::copy(found[range].begin(), found[range].end(),
              out.neighbor.begin() + static_cast<std::ptrdiff_t>(offset[range]));
  });
}

}  // namespace vorpipe
