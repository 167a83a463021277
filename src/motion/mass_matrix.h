/// The derivative of cell masses with respect to weights.
#pragma once

#include <cstdint>

#include "motion/linear/laplacian.h"
#include "vorpipe.h"

namespace vorpipe::moving {

/// Fills `matrix` with d mass / d weight. Walls, and images of a cell's own site, do not contribute.
void massMatrix(const CellsThatMeet& meet, const EdgesOfCells& edges, int threads, Laplacian& matrix);

}  // namespace vorpipe::moving
