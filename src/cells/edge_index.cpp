#include "cells/edge_index.h"

#include <algorithm>

#include "base/parallel.h"

namespace vorpipe::core {

EdgeIndex::EdgeIndex(const NeighborRows& cells, int threads) {
  for (const auto cell : cells.large()) large_.push_back({cell, {}});
  parallelFor(large_.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (auto k = begin; k < end; ++k) {
      const auto row = cells.edges(large_[k].cell);
      auto& edges = large_[k].edges;
      edges.resize(row.size());
      for (std::size_t e = 0; e < row.size(); ++e) edges[e] = {row[e], static_cast<std::uint32_t>(e)};
      std::sort(edges.begin(), edges.end());
    }
  });
}

std::size_t EdgeIndex::findInLarge(std::size_t cell, std::int32_t neighbor) const {
  const auto large = std::lower_bound(large_.begin(), large_.end(), cell,
                                      [](const Large& l, std::size_t wanted) { return l.cell < wanted; });
  const auto found =
      std::lower_bound(large->edges.begin(), large->edges.end(), std::pair{neighbor, std::uint32_t{0}});
  return found != large->edges.end() && found->first == neighbor ? found->second : none;
}

}  // namespace vorpipe::core
