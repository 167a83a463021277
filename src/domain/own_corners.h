/// The cells of a run by their own corners, before ties join these: only so masses are as right as areas, and
/// change smoothly with weights and places of sites.
#pragma once

#include "cells/cell_record.h"
#include "domain/cells_run.h"
#include "domain/weighing.h"

namespace vorpipe::core {

/// Cells that were found and agreed on. All of it outlives the call.
struct OwnCorners {
  const SiteSet& set;
  const NeighborRows& rows;
  Unscale unscale;
  const Sites& places;  ///< in the caller's units; what the set has beyond them are images
  int threads;
  const OwnParts* parts = nullptr;  ///< of the cells that an outline cuts, if there is one
};

/// Those of cells that were found with these options, and with their run. `places` are the sites as wrapped()
/// has them.
OwnCorners ownCorners(const FoundCells& found, const CellsOptions& options, const Sites& places, int threads);

/// Gives cells, whose areas and centroids stand in `records`, the moments of their mass.
void weighCells(const OwnCorners& cells, const DensityPixels& pixels, const MassRecords& records);

}  // namespace vorpipe::core
