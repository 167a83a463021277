/// The edges of cells in a box, as solvers need them.
#pragma once

#include "domain/density_pixels.h"
#include "session/box_moments.h"

namespace vorpipe::core {

/// Returns the edges of cells that findMoments() found, in the order of `meet`, the result of neighborsOf()
/// for them. `pixels` is null if there is no density.
EdgesOfCells edgesOf(const FoundBox& found, const CellsThatMeet& meet, const DensityPixels* pixels,
                     int threads);

}  // namespace vorpipe::core
