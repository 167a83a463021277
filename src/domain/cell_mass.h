/// The mass of cells under a density of pixels.
#pragma once

#include "domain/own_corners.h"

namespace vorpipe::core {

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
