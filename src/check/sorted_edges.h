/// The edges of each cell, to be found by what they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "check/run.h"

namespace vorpipe::core::checks {

/// A hub has an edge with each of its many neighbors, and an outline of many narrow parts leaves two cells
/// thousands of edges in common: looking through all of them for each would take the square of that.
class SortedEdges {
 public:
  /// Keeps a reference.
  explicit SortedEdges(const CheckedCells& run);

  /// Whether cell i has an edge with site j.
  [[nodiscard]] bool has(std::size_t i, std::size_t j) const;
  /// The same from a to b, in a diagram with polygons and rings as they should be.
  [[nodiscard]] bool has(std::size_t i, std::size_t j, Point a, Point b) const;

 private:
  [[nodiscard]] std::int64_t neighbor(std::size_t i, std::uint32_t k) const {
    return run_.diagram.neighbors[run_.begin(i) + k];
  }
  /// Where edge k of cell i begins.
  [[nodiscard]] Point from(std::size_t i, std::uint32_t k) const { return run_.vertex(run_.begin(i) + k); }
  /// Where it ends, in its ring.
  [[nodiscard]] Point to(std::size_t i, std::uint32_t k) const;
  [[nodiscard]] std::span<const std::uint32_t> edgesOf(std::size_t i) const {
    return std::span(edges_).subspan(run_.begin(i), run_.edges(i));
  }

  const CheckedCells& run_;
  std::vector<std::uint32_t> edges_;  ///< of each cell, by neighbor, and by where they begin
};

}  // namespace vorpipe::core::checks
