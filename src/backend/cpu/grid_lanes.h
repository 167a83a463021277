/// Cells clipped side by side in the lanes of vector instructions.
#pragma once

#include "backend/cpu/lane_job.h"

namespace vorpipe::cpu {

/// Finds the cells of a job with room for EDGES_FAST edges, or with `roomy` for EDGES_MOST; neighbors holds
/// as many for each cell, and one more where sites have weights.
using FindInLanes = void (*)(const LaneJob& job, bool roomy);

/// The fastest for this processor, for sites with weights or without. All give the same bytes.
FindInLanes findInLanes(bool weighted);

}  // namespace vorpipe::cpu
