/// Clips lists of lines with the shared algorithm on all threads.
#pragma once

#include "backend/backend.h"

namespace vorpipe::cpu {

/// Clips each entry in float, widened by outset (scaled units along x and y), and writes its status. The
/// statuses are those that a GPU would return.
void clipStatuses(const CellBatch<float>& batch, float outset_x, float outset_y, Capacity capacity,
                  int threads, std::span<CellStatus> status);

/// Clips each entry in double, with room for as many edges as the entry has lines, up to 2^17 in all.
/// `certified` refers to the shape: among lines that are parallel within rounding, any may carry an edge.
void clipBatch(const CellBatch<double>& batch, int threads, CellNeighbors& out);

}  // namespace vorpipe::cpu
