/// Edges that have become one, because a face between them vanished.
#pragma once

#include <array>
#include <cstddef>
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
  explicit EdgeClasses(std::size_t edges);
  /// Two edges are one.
  void join(std::uint32_t a, std::uint32_t b);
  /// An edge is one with one that is not among these: a longer one.
  void open(std::uint32_t edge) { open_[rootOf(edge)] = 1; }
  /// Whether all edges of an edge's class are among these.
  [[nodiscard]] bool isWhole(std::uint32_t edge) { return open_[rootOf(edge)] == 0; }

 private:
  std::uint32_t rootOf(std::uint32_t edge);

  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> open_;  ///< by root
};

}  // namespace vorpipe::space
