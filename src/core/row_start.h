/// Where the edges of a cell begin.
#pragma once

#include <algorithm>

#include "core/edge_index.h"

namespace vorpipe {

/// A neighbor as a Diagram has it: a wall, or an index in the input.
inline std::int64_t outsideIndex(const SiteSet& sites, std::int32_t neighbor) {
  return neighbor < 0 ? std::int64_t{neighbor} : std::int64_t{sites.id[static_cast<std::size_t>(neighbor)]};
}

/// The edge to the lowest wall, or else to the site of the lowest input index; 0 if there is a neighbor that
/// is neither.
inline std::size_t firstEdge(const SiteSet& sites, std::span<const std::int32_t> row) {
  std::size_t first = 0;
  std::int64_t lowest = no_site;
  for (std::size_t e = 0; e < row.size(); ++e) {
    if (row[e] >= 0 && static_cast<std::size_t>(row[e]) >= sites.size()) return 0;
    const auto index = outsideIndex(sites, row[e]);
    first = index < lowest ? e : first;
    lowest = std::min(index, lowest);
  }
  return first;
}

/// Turns a row of neighbors so that it begins with its first edge: then the diagram, sums of rounded numbers
/// included, is the same wherever a search began.
inline void beginAtFirst(const SiteSet& sites, std::span<std::int32_t> row) {
  const auto first = static_cast<std::ptrdiff_t>(firstEdge(sites, row));
  std::rotate(row.begin(), row.begin() + first, row.end());
}

/// The same while a row is copied to `out`.
inline void copyFromFirst(const SiteSet& sites, std::span<const std::int32_t> row, std::int32_t* out) {
  auto e = firstEdge(sites, row);
  // Too short for the functions that copy memory.
  for (std::size_t k = 0; k < row.size(); ++k) {
    out[k] = row[e];
    e = e + 1 < row.size() ? e + 1 : 0;
  }
}

}  // namespace vorpipe
