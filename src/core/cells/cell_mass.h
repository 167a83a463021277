/// The mass of cells under a density of pixels.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

/// Refuses sizes below 1, another number of values than pixels, and values that are negative or not finite.
/// Error (input): names the row and column, from 0.
Result<void> checkDensity(const Density& density);

/// Fills mass and mass_centroid of a diagram that has polygons, with or without rings. The density covers the
/// domain, and is repeated along periodic axes, as the cells reach beyond the domain there.
///
/// The integrals are those of Green's theorem along the edges, exact for the pixels but for rounding: the
/// area of a cell in a pixel is right to some 1e-14 of the pixel, or of the cell's bounding box where that is
/// smaller, whatever lies in other pixels: none has a share in a cell that it does not touch, and nothing
/// large is subtracted. The time is that of the pixels that cells touch, each for each of its cells.
///
/// `spread`, which may be null, gets for each cell the integral of the squared distance to the center of
/// mass, in mass times length squared; from the same integrals, so that it is as exact as the mass. 0 without
/// mass.
void measureMass(const Density& density, const Box& domain, Periodic periodic, int threads, Diagram& diagram,
                 std::vector<double>* spread = nullptr);

}  // namespace vorpipe::core
