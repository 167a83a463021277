/// The search for cells that nearest neighbors do not certify: long, thin, or with many neighbors.
#pragma once

#include "backend/backend.h"
#include "core/candidates.h"
#include "core/flann_search.h"

namespace vorpipe {

/// Cells found complete on the host.
struct HostCells {
  Candidates candidates;  ///< the sites whose bisectors bound each cell, and its bounding box
  CellPolygons polygons;  ///< entry by entry as in candidates; status certified or empty
};

/// Finds the cells of `which` (indices in the set), clipped by `judge` in double. A cell is complete
/// when no vertex of it has a nearer site than its own: the cell is convex, so all of it is its
/// site's. Each round asks for the site nearest to every vertex and cuts by those that are nearer.
/// Errors: those of the judge; a cell with more edges than it holds.
Result<HostCells> findCells(const SiteSet& sites, const FlannSearch& search, Backend& judge,
                            std::span<const std::uint32_t> which, int threads);

}  // namespace vorpipe
