/// The cells of a run by their own corners, before ties join these. Only these make masses as accurate as
/// areas, and smooth in weights and positions of sites.
#pragma once

#include "cells/cell_record.h"
#include "domain/cells_run.h"
#include "domain/weighing.h"

namespace vorpipe::core {

/// Cells that were found and agreed on. Everything here outlives the call.
struct OwnCorners {
  const SiteSet& set;
  const NeighborRows& rows;
  Unscale unscale;
  const Sites& places;  ///< in the caller's units; further sites of the set are images
  int threads;
  const OwnParts* parts = nullptr;  ///< for the cells that an outline cuts, if there is one
};

/// The corners of cells that were found with these options, and with their run. `places` are the sites as
/// wrapped() returns them.
OwnCorners ownCorners(const FoundCells& found, const CellsOptions& options, const Sites& places, int threads);

/// Computes the moments of mass of cells, whose areas and centroids are already in `records`.
void weighCells(const OwnCorners& cells, const DensityPixels& pixels, const MassRecords& records);

}  // namespace vorpipe::core
