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

EdgeClasses::EdgeClasses(std::size_t edges) : parent_(edges), open_(edges, 0) {
  std::iota(parent_.begin(), parent_.end(), 0U);
}

std::uint32_t EdgeClasses::rootOf(std::uint32_t edge) {
  while (parent_[edge] != edge) edge = parent_[edge] = parent_[parent_[edge]];
  return edge;
}

void EdgeClasses::join(std::uint32_t a, std::uint32_t b) {
  a = rootOf(a);
  b = rootOf(b);
  if (a == b) return;
  if (a > b) std::swap(a, b);
  parent_[b] = a;
  open_[a] = open_[a] | open_[b];
}

}  // namespace vorpipe::space
