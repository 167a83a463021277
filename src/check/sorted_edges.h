/// The edges of each cell, searchable by neighbor and ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "check/run.h"

namespace vorpipe::core::checks {

/// A hub has an edge with each of its many neighbors, and with an outline of many narrow parts two cells may
/// share thousands of edges. Searching them linearly for each edge would take quadratic time.
class SortedEdges {
 public:
  /// Keeps a reference.
  explicit SortedEdges(const CheckedCells& run);

  /// Whether cell i has an edge with site j.
  [[nodiscard]] bool has(std::size_t i, std::size_t j) const;
  /// The same for an edge from a to b, in a diagram with valid polygons and rings.
  [[nodiscard]] bool has(std::size_t i, std::size_t j, Point a, Point b) const;

 private:
  [[nodiscard]] std::int64_t neighbor(std::size_t i, std::uint32_t k) const {
    return run_.diagram.neighbors[run_.begin(i) + k];
  }
  /// The start of edge k of cell i.
  [[nodiscard]] Point from(std::size_t i, std::uint32_t k) const { return run_.vertex(run_.begin(i) + k); }
  /// Its end, in its ring.
  [[nodiscard]] Point to(std::size_t i, std::uint32_t k) const;
  [[nodiscard]] std::span<const std::uint32_t> edgesOf(std::size_t i) const {
    return std::span(edges_).subspan(run_.begin(i), run_.edges(i));
  }

  const CheckedCells& run_;
  std::vector<std::uint32_t> edges_;  ///< of each cell, sorted by neighbor and start
};

}  // namespace vorpipe::core::checks
