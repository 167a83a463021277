/// The mass of cells under a density of pixels.
#pragma once

#include "domain/own_corners.h"

namespace vorpipe::core {

/// Refuses sizes below 1, another number of values than pixels, and values that are negative or not finite.
/// Error (input): names the row and column, from 0.
Result<void> checkDensity(const Density& density);

/// Fills mass and mass_centroid of cells that were found with these options, their density apart, and with
/// their run. They need no polygons: as areas, masses are those of cells before ties join their corners. The
/// density covers the domain, and is repeated along periodic axes, as the cells reach beyond the domain
/// there.
///
/// The integrals are those of Green's theorem along the edges, exact for the pixels but for rounding: the
/// area of a cell in a pixel is right to some 1e-14 of the pixel, or of the cell's bounding box where that is
/// smaller, whatever lies in other pixels: none has a share in a cell that it does not touch, and nothing
/// large is subtracted. The time is that of the pixels that cells touch, each for each of its cells.
///
/// Errors: those of wrapped().
Result<void> measureMass(const CellsOptions& options, const Sites& sites, int threads, FoundCells& found);

}  // namespace vorpipe::core
