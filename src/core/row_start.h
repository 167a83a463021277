/// Where the edges of a cell begin.
#pragma once

#include <algorithm>

#include "core/edge_index.h"

namespace vorpipe {

/// A neighbor as a Diagram has it: a wall, or an index in the input.
inline std::int64_t outsideIndex(const SiteSet& sites, std::int32_t neighbor) {
  return neighbor < 0 ? std::int64_t{neighbor} : std::int64_t{sites.id[static_cast<std::size_t>(neighbor)]};
}

/// Turns a row of neighbors so that its first is the lowest wall, or else the site of the lowest input
/// index: then the diagram, sums of rounded numbers included, is the same wherever a search began.
inline void beginAtFirst(const SiteSet& sites, std::span<std::int32_t> row) {
  const auto in_range = [&](std::int32_t n) { return n < 0 || static_cast<std::size_t>(n) < sites.size(); };
  std::size_t first = 0;
  std::int64_t lowest = no_site;
  for (std::size_t e = 0; e < row.size(); ++e) {
    if (!in_range(row[e])) return;
    const auto index = outsideIndex(sites, row[e]);
    first = index < lowest ? e : first;
    lowest = std::min(index, lowest);
  }
  std::rotate(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(first), row.end());
}

}  // namespace vorpipe
