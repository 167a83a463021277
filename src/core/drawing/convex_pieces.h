/// Cells with more edges than a device holds, cut into convex pieces that it does hold.
#pragma once

#include "backend/backend.h"

namespace vorpipe::core {

/// Appends the pieces of one polygon (vertices counter-clockwise, relative to its origin) to out: a fan
/// from the first vertex, each piece with at most `most_edges` edges, three at least; none for a polygon
/// smaller than a billionth of the domain. Returns how many pieces were added.
std::size_t appendPieces(std::span<const Point> polygon, std::size_t most_edges, double tolerance,
                         CellBatch<float>& out);

}  // namespace vorpipe::core
