/// More points in the edges of an outline's rings.
#pragma once

#include "domain/edge_tree.h"

namespace vorpipe::core {

/// A place that is to become a point of an edge.
struct EdgeNode {
  std::uint32_t edge;
  Point at;
};

/// The rings with these points in their edges, each once; one at an end of its edge is there already.
Rings withNodes(const Rings& rings, std::vector<EdgeNode> nodes);

}  // namespace vorpipe::core
