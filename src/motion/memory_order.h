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

/// Returns values, or sites, in that order; none if there are none.
template <class Value>
std::vector<Value> inOrder(const std::vector<Value>& values, const std::vector<std::uint32_t>& order) {
  std::vector<Value> sorted(values.empty() ? 0 : order.size());
  for (std::size_t k = 0; k < sorted.size(); ++k) sorted[k] = values[order[k]];
  return sorted;
}
inline Sites inOrder(const Sites& sites, const std::vector<std::uint32_t>& order) {
  return {inOrder(sites.x, order), inOrder(sites.y, order), inOrder(sites.weight, order)};
}

/// Returns values from that order in the caller's.
template <class Value>
std::vector<Value> inCallersOrder(const std::vector<Value>& values, const std::vector<std::uint32_t>& order) {
  std::vector<Value> unsorted(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) unsorted[order[k]] = values[k];
  return unsorted;
}

}  // namespace vorpipe::moving
