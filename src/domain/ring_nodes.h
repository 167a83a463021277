/// Inserts points into the edges of an outline's rings.
#pragma once

#include "domain/edge_tree.h"

namespace vorpipe::core {

/// A point to insert into an edge.
struct EdgeNode {
  std::uint32_t edge;
  Point at;
};

/// The rings with these points in their edges, each once; a point at an end of its edge is already there.
Rings withNodes(const Rings& rings, std::vector<EdgeNode> nodes);

}  // namespace vorpipe::core
