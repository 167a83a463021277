/// Cells that the judge found, as a device can draw them.
#pragma once

#include "core/judge/neighbor_rows.h"
#include "core/search/candidates.h"

namespace vorpipe::core {

/// The cells of some sites; entry e of `found`, certified or empty, is the cell of which[e].
struct JudgedCells {
  std::vector<std::uint32_t> which;
  NeighborRows found;
};

/// The sites that bound the cells `entries`, and the box of each cell.
Candidates boundaries(const SiteSet& sites, const JudgedCells& cells, std::span<const std::uint32_t> entries,
                      int threads);

/// The corners of a cell, counter-clockwise, seen from its origin.
std::vector<Point> cellPolygon(const SiteSet& sites, std::uint32_t site,
                               std::span<const std::int32_t> neighbors);

}  // namespace vorpipe::core
