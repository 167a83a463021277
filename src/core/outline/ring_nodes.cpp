#include "core/outline/ring_nodes.h"

#include <algorithm>
#include <tuple>

#include "base/parallel.h"
#include "core/geometry/predicates.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t touching_grain = 4096;

}  // namespace

std::vector<EdgeNode> touchingCorners(const OutlineIndex& index, int threads) {
  const Rings& rings = index.rings();
  std::vector<std::vector<EdgeNode>> found((rings.size() + touching_grain - 1) / touching_grain);
  parallelFor(rings.size(), touching_grain, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> edges;
    for (auto c = begin; c < end; ++c) {
      const Point corner = rings.points[c];
      index.edgesIn({corner.x, corner.y, corner.x, corner.y}, edges);
      for (const auto e : edges) {
        const Point p = rings.points[e], q = rings.points[rings.next(e)];
        if (p == corner || q == corner || orientation(p, q, corner) != 0) continue;
        found[begin / touching_grain].push_back({e, corner});
      }
    }
  });
  std::vector<EdgeNode> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

Rings withNodes(const Rings& rings, std::vector<EdgeNode> nodes) {
  std::ranges::sort(nodes, {}, [&](const EdgeNode& node) {
    const Point p = rings.points[node.edge], q = rings.points[rings.next(node.edge)];
    return std::tuple(node.edge, alongWay(p, q, node.at), node.at.x, node.at.y);
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
