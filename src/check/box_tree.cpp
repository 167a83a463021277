#include "check/box_tree.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace vorpipe::core::checks {

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (order_.empty()) return;
  nodes_.resize(2 * std::bit_ceil(order_.size() / leaf_size + 1));
  build({1, 0, order_.size()});
}

void BoxTree::build(const Node& node) {
  const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  Box all = boxes_[order_[node.begin]];
  for (std::size_t k = node.begin; k < node.end; ++k) {
    const Box& box = boxes_[order_[k]];
    all = {std::min(all.xmin, box.xmin), std::min(all.ymin, box.ymin), std::max(all.xmax, box.xmax),
           std::max(all.ymax, box.ymax)};
  }
  nodes_[node.number] = all;
  if (node.isLeaf()) return;
  const bool across_x = all.xmax - all.xmin > all.ymax - all.ymin;
  const auto place = [&](std::uint32_t k) {
    const Box& box = boxes_[k];
    return across_x ? box.xmin + box.xmax : box.ymin + box.ymax;
  };
  std::ranges::nth_element(at(node.begin), at(node.middle()), at(node.end), {}, place);
  build(node.lower());
  build(node.upper());
}

}  // namespace vorpipe::core::checks
