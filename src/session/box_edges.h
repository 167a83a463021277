/// The edges of cells in a box, as solvers ask for them.
#pragma once

#include "domain/density_pixels.h"
#include "session/box_moments.h"

namespace vorpipe::core {

/// Of cells that findMoments() found, in the order of `meet`, which neighborsOf() made of them. `pixels` may
/// be null: there is no density.
EdgesOfCells edgesOf(const FoundBox& found, const CellsThatMeet& meet, const DensityPixels* pixels,
                     int threads);

}  // namespace vorpipe::core
