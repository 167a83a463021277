/// The vertices that ties make.
#pragma once

#include "base/disjoint_sets.h"
#include "cells/tied_cells.h"

namespace vorpipe::core {

/// Makes one vertex of each set of corners: numbers the vertices, lists the cells around each, and computes
/// their positions, as documented at resolveTies.
void makeVertices(const ProposedCells& proposed, DisjointSets& corners, TiedCells& tied);

}  // namespace vorpipe::core
