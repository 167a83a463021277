/// The vertices that ties make.
#pragma once

#include "base/disjoint_sets.h"
#include "core/ties/ties.h"

namespace vorpipe::core {

/// Makes one vertex of each set of corners: numbers them, finds out which cells meet there, and places
/// them, as resolveTies says.
void makeVertices(const ProposedCells& proposed, DisjointSets& corners, TiedCells& tied);

}  // namespace vorpipe::core
