#include "cells/tied_cells.h"

#include <algorithm>

namespace vorpipe::core {

void keptEdges(const ProposedCells& proposed, const TiedCells& tied, std::size_t k,
               std::vector<std::uint32_t>& edges) {
  edges.clear();
  const auto row = proposed.cells.edges(tied.cell[k]);
  for (std::uint32_t e = 0; e < row.size(); ++e) {
    if (tied.tie[tied.offsets[k] + e] == 0) edges.push_back(e);
  }
  const auto lowest =
      std::min_element(edges.begin(), edges.end(), [&](auto a, auto b) { return row[a] < row[b]; });
  std::rotate(edges.begin(), lowest, edges.end());
}

}  // namespace vorpipe::core
