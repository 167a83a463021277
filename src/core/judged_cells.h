/// Cells that the judge found, as a device can draw them.
#pragma once

#include "backend/backend.h"
#include "core/candidates.h"

namespace vorpipe {

/// The cells of some sites; entry e of `found`, certified or empty, is the cell of which[e].
struct JudgedCells {
  std::vector<std::uint32_t> which;
  Neighborhoods found;

  [[nodiscard]] std::span<const std::int32_t> neighbors(std::size_t e) const {
    return std::span(found.neighbor).subspan(found.first[e], found.first[e + 1] - found.first[e]);
  }
};

/// The sites that bound the cells `entries`, and the box of each cell.
Candidates boundaries(const SiteSet& sites, const JudgedCells& cells, std::span<const std::uint32_t> entries,
                      int threads);

/// The corners of a cell, counter-clockwise, seen from its origin.
std::vector<Point> cellPolygon(const SiteSet& sites, std::uint32_t site,
                               std::span<const std::int32_t> neighbors);

}  // namespace vorpipe
