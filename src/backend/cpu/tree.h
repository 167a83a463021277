/// A kd-tree over the sites: no distribution of sites makes its search slow (decision D36).
#pragma once

#include <cstdint>
#include <vector>

#include "backend/backend.h"

namespace vorpipe::cpu {

/// Bounds of the sites of a node. A rotated rectangle holds point + (ux, uy) a + (-uy, ux) b for a in [low_a,
/// high_a] and b in [low_b, high_b]. A circle is added where that is tighter, for sites along a curve: they
/// lie on or outside of it. (ux, uy) has length 1 up to rounding; the center is relative to the point.
struct Bounds {
  double x, y, ux, uy;
  double low_a, high_a, low_b, high_b;
  double center_x, center_y, radius;  ///< radius 0: no circle
  double heaviest;  ///< no site of the node has a larger weight, except a heavy one of the set
};

/// A balanced tree. The rank of a site is its index in the order of the leaves; every node holds a range of
/// ranks, its children hold the halves of it. Nodes are numbered as in a heap, from 1; those from first_leaf
/// on are leaves. The tree depends on the sites alone.
struct SiteTree {
  struct Range {
    std::uint32_t begin, end;
    [[nodiscard]] std::uint32_t middle() const { return begin + (end - begin) / 2; }
  };

  SiteTree(const SiteSet& sites, int threads);

  [[nodiscard]] bool isLeaf(std::uint32_t node) const { return node >= first_leaf; }
  [[nodiscard]] Range all() const { return {0, static_cast<std::uint32_t>(site.size())}; }

  std::uint32_t first_leaf = 1;
  std::vector<Bounds> bounds;       ///< by node
  std::vector<std::uint32_t> site;  ///< by rank: an index in the set
  std::vector<std::uint32_t> rank;  ///< by index in the set
  std::vector<double> x, y;         ///< by rank
  std::vector<double> weight;       ///< by rank; empty where sites have none
};

}  // namespace vorpipe::cpu
