/// Groups rows of a level that become one row of the next level.
#pragma once

#include <cstdint>
#include <vector>

#include "motion/linear/level.h"

namespace vorpipe::moving {

/// Sets the aggregate of each row as in Vanek, Mandel and Brezina (1996, algorithm 5.1), for each block
/// separately. A row and those strongly coupled to it form an aggregate, if none of them is taken. Each
/// remaining row joins the aggregate that it is coupled to most. A coupling is strong if it is more than
/// `strength` times the root of the product of both diagonals. A row whose extra far exceeds its couplings
/// has no aggregate: sweeps solve for it. Returns the first aggregate of each block, then the number of
/// aggregates.
std::vector<std::uint32_t> findAggregates(Level& level, float strength, int threads);

}  // namespace vorpipe::moving
