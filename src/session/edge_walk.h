/// Visits the edges of cells in a box, as solvers need them.
#pragma once

#include <vector>

#include "base/parallel.h"
#include "cells/cell_walk.h"
#include "session/box_moments.h"

namespace vorpipe::core {

/// One edge, and the index of its values in CellsThatMeet.
struct WalkedEdge {
  std::uint32_t cell;
  std::int32_t neighbor;
  const AnchoredPoint &begin, &end;  ///< corners before ties join them
  std::uint64_t out;
};

/// Calls take(edge) for each edge of cells that findMoments() found, except those that ties remove. It runs
/// on several threads; each has its own `take` from makeTaker(). `meet` is the result of neighborsOf() for
/// the cells.
template <class MakeTaker>
void walkEdges(const FoundBox& found, const CellsThatMeet& meet, int threads, const MakeTaker& makeTaker) {
  constexpr std::size_t grain = 4096;
  const SiteSet& set = found.run->prepared.set;
  const NeighborRows& cells = found.cells->rows;
  const TiedCells& tied = found.cells->tied;
  const EdgeIndex index(cells, threads);
  const ProposedCells proposed{set, cells, index, threads};
  parallelFor(set.size(), grainFor(set.size(), grain), threads, [&](std::size_t first, std::size_t last) {
    auto take = makeTaker();
    CellWalk walk(set, cells);
    std::vector<std::uint32_t> kept;
    walk(first, last, [&](std::uint32_t cell, auto row, auto corners) {
      auto out = meet.offsets[set.id[cell]];
      const auto takeEdge = [&](std::size_t e) {
        take(WalkedEdge{cell, row[e], corners[e], corners[e + 1 < row.size() ? e + 1 : 0], out++});
      };
      if (!tied.has(cell)) {
        for (std::size_t e = 0; e < row.size(); ++e) takeEdge(e);
        return;
      }
      keptEdges(proposed, tied, tied.entry[cell], kept);
      for (const auto e : kept) takeEdge(e);
    });
  });
}

}  // namespace vorpipe::core
