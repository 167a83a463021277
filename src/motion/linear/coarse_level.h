/// The next level of a multigrid.
#pragma once

#include "motion/linear/level.h"

namespace vorpipe::moving {

/// Sets the matrix of `coarse` to P^T L P, where P is 1 for a row of `fine` and its aggregate, else 0. So
/// couplings between aggregates are summed, and so are extras. `starts` are those of findAggregates().
void makeCoarse(const Level& fine, const std::vector<std::uint32_t>& starts, int threads, Level& coarse);

}  // namespace vorpipe::moving
