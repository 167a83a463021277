/// The vertices that ties make, for resolveTies.
#pragma once

#include "base/disjoint_sets.h"
#include "cells/tied_cells.h"
#include "cells/ties.h"

namespace vorpipe::core {

/// Makes one vertex of each set of corners: numbers the vertices, lists the cells around each, and computes
/// their positions, as documented at resolveTies.
void makeVertices(const ProposedCells& proposed, DisjointSets& corners, TiedCells& tied);

/// Turns all edges whose two ends are one vertex into ties. With weights, a ring of ties may enclose cells
/// that share longer edges, because their sites are nearer to each other than to those around. Such cells
/// become one vertex, without edges. Enclosed cells that are not in `tied` are listed in `tied.enclosed`; the
/// caller then repeats with them.
///
/// The cells that keep edges then form a partition: one ring of edges bounds each, and each is connected to
/// the domain's walls through others.
void dropCollapsed(const ProposedCells& proposed, DisjointSets& corners, TiedCells& tied);

/// The cells around wide vertices, ascending, except those whose ties are already the finest.
struct WideVertices {
  std::vector<std::uint32_t> nearly;  ///< a vertex is wide, or might be if its cells were exact
  std::vector<std::uint32_t> quite;   ///< these need finer ties, if all of them are exact
};

/// A vertex is wide where one of the corners that ties joined is farther from it than `--check` allows for
/// polygons, and nearly wide at half of that.
WideVertices findWideVertices(const ProposedCells& proposed, const TiedCells& tied, const Fineness& fineness);

}  // namespace vorpipe::core
