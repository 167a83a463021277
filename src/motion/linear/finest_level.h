/// The first level of a multigrid.
#pragma once

#include "motion/linear/laplacian.h"
#include "motion/linear/level.h"

namespace vorpipe::moving {

/// Copies a matrix in units of its greatest coupling or extra. Values too small for single precision stay
/// above 0, so that parts of the graph stay connected.
void takeMatrix(const Laplacian& matrix, int threads, Level& level);

}  // namespace vorpipe::moving
