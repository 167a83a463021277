/// What a cycle does on a level.
#pragma once

#include <vector>

#include "motion/linear/level.h"

namespace vorpipe::moving {

/// A sweep of Gauss and Seidel from x = 0, by block.
void sweepForward(Level& level, int threads);

/// The right side of the next level: what that sweep left of each aggregate's.
void passOn(Level& level, int threads, Level& coarse);

/// Adds to x what the next level found.
void takeBack(const Level& coarse, int threads, Level& level);

/// A sweep in the other direction. The right side is changed.
void sweepBackward(Level& level, int threads);

}  // namespace vorpipe::moving
