/// Edges that have become one, because a face between them vanished.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
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
  /// Calls each(members, labels) for each class all of whose edges are among them: the places of its edges
  /// among them, and all of their labels, each once.
  template <class Each>
  void forEachWhole(const Each& each) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_class;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) by_class.emplace_back(rootOf(e), e);
    std::ranges::sort(by_class);
    std::vector<std::uint32_t> members;
    std::vector<Label> labels;
    for (std::size_t k = 0; k < by_class.size(); ++k) {
      const auto [root, edge] = by_class[k];
      members.push_back(edge);
      labels.insert(labels.end(), edges_[edge].begin(), edges_[edge].end());
      if (k + 1 < by_class.size() && by_class[k + 1].first == root) continue;
      if (open_[root] == 0) {
        std::ranges::sort(labels);
        labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
        each(std::span<const std::uint32_t>(members), std::span<const Label>(labels));
      }
      members.clear();
      labels.clear();
    }
  }

 private:
  std::uint32_t rootOf(std::uint32_t edge);

  std::vector<EdgeLabels> edges_;
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> open_;  ///< by root: 1 if a longer edge is one of the class
};

}  // namespace vorpipe::space
