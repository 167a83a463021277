/// The mass of cells under a density of pixels.
#pragma once

#include "cells/cell_record.h"
#include "domain/cells_run.h"
#include "domain/polygon_mass.h"

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

/// Refuses sizes below 1, another number of values than pixels, and values that are negative or not finite.
/// Error (input): names the row and column, from 0.
Result<void> checkDensity(const Density& density);

/// Fills mass and mass_centroid of cells that were found with these options except their density, and with
/// their run. Polygons are not needed: like areas, masses are those of cells before ties join their corners.
/// The density covers the domain and repeats along periodic axes, where cells reach beyond the domain.
///
/// The integrals follow from Green's theorem along the edges; they are exact for the pixels except for
/// rounding. The area of a cell in a pixel is accurate to about 1e-14 of the pixel, or of the cell's bounding
/// box if that is smaller. Other pixels have no influence: pixels contribute only to cells that they touch,
/// and nothing large is subtracted. The time is proportional to the number of pixels that each cell touches,
/// summed over cells.
///
/// Errors: those of wrapped().
Result<void> measureMass(const CellsOptions& options, const Sites& sites, int threads, FoundCells& found);

}  // namespace vorpipe::core
