/// Rows of a level that become one row of the next.
#pragma once

#include <cstdint>
#include <vector>

#include "motion/linear/level.h"

namespace vorpipe::moving {

/// Sets the aggregate of each row, in the way of Vanek, Mandel and Brezina (1996, algorithm 5.1), in each
/// block for itself: a row and those strongly coupled to it, where none of them is taken; what is left joins
/// the aggregate that it is coupled to most. A coupling is strong if it is more than `strength` times the
/// root of the product of both diagonals. Rows have no aggregate whose extra is far more than their
/// couplings: sweeps solve for them. Returns where the aggregates of each block begin; last their number.
std::vector<std::uint32_t> findAggregates(Level& level, float strength, int threads);

}  // namespace vorpipe::moving
