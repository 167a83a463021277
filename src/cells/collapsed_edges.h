/// Edges that collapse because ties join their ends.
#pragma once

#include "base/disjoint_sets.h"
#include "cells/tied_cells.h"

namespace vorpipe::core {

/// Turns all edges whose two ends are one vertex into ties. With weights, a ring of ties may enclose cells
/// that share longer edges, because their sites are nearer to each other than to those around. Such cells
/// become one vertex, without edges. Enclosed cells that are not in `tied` are listed in `tied.enclosed`; the
/// caller then repeats with them.
///
/// The cells that keep edges then form a partition: one ring of edges bounds each, and each is connected to
/// the domain's walls through others.
void dropCollapsed(const ProposedCells& proposed, DisjointSets& corners, TiedCells& tied);

}  // namespace vorpipe::core
