/// The operations of a cycle on a level.
#pragma once

#include <vector>

#include "motion/linear/level.h"

namespace vorpipe::moving {

/// Makes a Gauss-Seidel sweep from x = 0, by block.
void sweepForward(Level& level, int threads);

/// Sets the right side of the next level: the residual of that sweep, summed by aggregate.
void passOn(Level& level, int threads, Level& coarse);

/// Adds to x the correction from the next level.
void takeBack(const Level& coarse, int threads, Level& level);

/// Makes a sweep in the other direction. Changes the right side.
void sweepBackward(Level& level, int threads);

}  // namespace vorpipe::moving
