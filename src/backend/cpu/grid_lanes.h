/// Clips cells in parallel in the lanes of vector instructions.
#pragma once

#include "backend/cpu/lane_job.h"

namespace vorpipe::cpu {

/// Finds the cells of a job, each of at most EDGES_FAST edges at once, or EDGES_MOST if `large`. The job's
/// `neighbors` holds as many per cell, and one more if sites have weights.
using FindInLanes = void (*)(const LaneJob& job, bool large);

/// Returns the fastest variant for this processor, for sites with or without weights. All give the same
/// bytes.
FindInLanes findInLanes(bool weighted);

}  // namespace vorpipe::cpu
