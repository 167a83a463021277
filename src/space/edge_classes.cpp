#include "space/edge_classes.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace vorpipe::space {

EdgeLabels edgeLabels(Label a, Label b, Label c) {
  EdgeLabels labels{a, b, c};
  std::ranges::sort(labels);
  return labels;
}

EdgeClasses::EdgeClasses(std::vector<EdgeLabels> edges)
    : edges_(std::move(edges)), parent_(edges_.size()), open_(edges_.size(), 0) {
  std::iota(parent_.begin(), parent_.end(), 0U);
}

std::uint32_t EdgeClasses::rootOf(std::uint32_t edge) {
  while (parent_[edge] != edge) edge = parent_[edge] = parent_[parent_[edge]];
  return edge;
}

void EdgeClasses::join(const EdgeLabels& edge, const EdgeLabels& other) {
  const auto at = [&](const EdgeLabels& labels) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(edges_, labels) - edges_.begin());
  };
  std::uint32_t a = rootOf(at(edge)), b = at(other);
  if (b == edges_.size() || edges_[b] != other) {
    open_[a] = 1;
    return;
  }
  b = rootOf(b);
  if (a == b) return;
  if (a > b) std::swap(a, b);
  parent_[b] = a;
  open_[a] = open_[a] | open_[b];
}

}  // namespace vorpipe::space
