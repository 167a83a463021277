/// Cells clipped by the shared algorithm on all threads.
#pragma once

#include "backend/backend.h"

namespace vorpipe::cpu {

/// Clips each entry in float, widened by outset (scaled units along x and y), and writes what
/// became of it. The statuses are those that a GPU would return.
void clipStatuses(const CellBatch<float>& batch, float outset_x, float outset_y, Room room, int threads,
                  std::span<CellStatus> status);

/// Clips each entry in double, with room for at least 1024 edges.
void clipPolygons(const CellBatch<double>& batch, int threads, CellPolygons& out);

/// Room for edges in clipPolygons.
int mostEdgesInDouble();

}  // namespace vorpipe::cpu
