/// Edges that have become one, because a face between them vanished.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "space/label.h"

namespace vorpipe::space {

/// The labels around an edge, ascending.
using EdgeLabels = std::array<Label, 3>;
EdgeLabels edgeLabels(Label a, Label b, Label c);

/// Sorts edges into classes by pairs that are one.
class EdgeClasses {
 public:
  /// Each edge once, ascending.
  explicit EdgeClasses(std::vector<EdgeLabels> edges);
  [[nodiscard]] const std::vector<EdgeLabels>& edges() const { return edges_; }
  /// Two edges are one; the first is among the edges, the other may be a longer one.
  void join(const EdgeLabels& edge, const EdgeLabels& other);
  /// Whether all edges of an edge's class are among them; by its place among them.
  [[nodiscard]] bool isWhole(std::uint32_t edge) { return open_[rootOf(edge)] == 0; }

 private:
  std::uint32_t rootOf(std::uint32_t edge);

  std::vector<EdgeLabels> edges_;
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> open_;  ///< by root: 1 if a longer edge is one of the class
};

}  // namespace vorpipe::space
