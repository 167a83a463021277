/// Cells in a box with a free surface: the parts of cells inside discs around the sites.
#pragma once

#include "session/box_moments.h"

namespace vorpipe::core {

/// Refuses options that a free surface does not support yet. Errors (input).
Result<void> checkFreeSurface(const CellsOptions& options, const Density& density);

/// Data of the last cells that their edges need, by input index.
struct FreeSurface {
  std::vector<double> weight;
  std::vector<double> arc;  ///< as in EdgesOfCells::arc
};

/// Removes the parts outside of the discs from the moments of cells that findMoments() found. The weights are
/// the squared radii of the discs around the sites. Cells with nothing left are empty.
void cutByDiscs(const FoundBox& found, const Sites& sites, int threads, CellMoments& moments, Report& report,
                FreeSurface& surface);

/// Returns the edges of these cells, as edgesOf() does.
EdgesOfCells edgesInDiscs(const FoundBox& found, const FreeSurface& surface, const CellsThatMeet& meet,
                          int threads);

}  // namespace vorpipe::core
