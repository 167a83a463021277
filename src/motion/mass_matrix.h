/// How masses of cells answer to their weights.
#pragma once

#include <cstdint>

#include "motion/linear/laplacian.h"
#include "vorpipe.h"

namespace vorpipe::moving {

/// Fills `matrix` with d mass / d weight: walls, and images of a cell's own site, have no part in it.
void massMatrix(const CellsThatMeet& meet, const EdgesOfCells& edges, int threads, Laplacian& matrix);

}  // namespace vorpipe::moving
