/// The first level of a multigrid.
#pragma once

#include "motion/linear/laplacian.h"
#include "motion/linear/level.h"

namespace vorpipe::moving {

/// Takes a matrix over, in units of its greatest coupling or extra. What is less than single precision holds
/// stays above 0, so that parts of the graph stay connected.
void takeMatrix(const Laplacian& matrix, int threads, Level& level);

}  // namespace vorpipe::moving
