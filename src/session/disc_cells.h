/// Cells in a box with a free surface: what discs around the sites have of them.
#pragma once

#include "session/box_moments.h"

namespace vorpipe::core {

/// Refuses what a free surface cannot have so far. Errors (input).
Result<void> checkFreeSurface(const CellsOptions& options, const Density& density);

/// What is kept of the last cells for their edges, by input index.
struct FreeSurface {
  std::vector<double> weight;
  std::vector<double> arc;  ///< as EdgesOfCells::arc
};

/// Takes from the moments of cells that findMoments() found what lies outside of the discs around their
/// sites, whose squared radii are the weights. Cells of which nothing is left are empty.
void cutByDiscs(const FoundBox& found, const Sites& sites, int threads, CellMoments& moments, Report& report,
                FreeSurface& surface);

/// Of these cells, as edgesOf().
EdgesOfCells edgesInDiscs(const FoundBox& found, const FreeSurface& surface, const CellsThatMeet& meet,
                          int threads);

}  // namespace vorpipe::core
