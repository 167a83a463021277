/// Edges for which ties leave no room.
#pragma once

#include "base/disjoint_sets.h"
#include "core/ties/ties.h"

namespace vorpipe::core {

/// Makes ties of all edges whose two ends are one vertex, since ties join them. Where sites have weights,
/// ties may go around cells that have longer edges among each other, because their sites are nearer to each
/// other than to those around: all of these are one vertex then, and their cells have no edges. If there are
/// some that are not in `tied`, they are listed in `tied.enclosed`, and all is to be done again with them.
///
/// So what is left is a partition in itself: each cell that has edges is bounded by one ring of them, and
/// every cell is joined to the domain's walls by others.
void dropCollapsed(const ProposedCells& proposed, DisjointSets& corners, TiedCells& tied);

}  // namespace vorpipe::core
