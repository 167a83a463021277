#include "domain/ring_nodes.h"

#include <algorithm>
#include <utility>

namespace vorpipe::core {

Rings withNodes(const Rings& rings, std::vector<EdgeNode> nodes) {
  std::ranges::sort(nodes, {}, [&](const EdgeNode& node) {
    const Point p = rings.points[node.edge], q = rings.points[rings.next(node.edge)];
    return std::pair(node.edge, placeAlong(p, q, node.at));
  });
  Rings refined;
  refined.outer = rings.outer;
  auto node = nodes.begin();
  for (std::uint32_t e = 0; e < rings.size(); ++e) {
    const auto ring = rings.ring[e];
    if (rings.offsets[ring] == e) refined.offsets.push_back(static_cast<std::uint32_t>(refined.size()));
    refined.points.push_back(rings.points[e]);
    const Point end = rings.points[rings.next(e)];
    for (; node != nodes.end() && node->edge == e; ++node) {
      if (node->at != refined.points.back() && node->at != end) refined.points.push_back(node->at);
    }
    refined.ring.resize(refined.size(), ring);
  }
  refined.offsets.push_back(static_cast<std::uint32_t>(refined.size()));
  return refined;
}

}  // namespace vorpipe::core
