/// Checks proposed cells against each other, and measures those that pass.
#pragma once

#include <span>
#include <vector>

#include "core/vertices/cell_record.h"
#include "core/vertices/edge_index.h"

namespace vorpipe::core {

/// Cells and what is needed to look at them; all of it outlives the use.
struct ProposedCells {
  const SiteSet& sites;
  const NeighborRows& cells;
  const EdgeIndex& index;
  int threads;
};

/// Checks the cells `which` in double. A cell passes when each edge is longer than a tie, and both cells
/// of each edge name the same sites and walls at its ends, and it is measured into `records`. A cell that
/// does not, and one beside a tie, is marked in `suspect`, which has an element for each cell: it is
/// resolveTies' to say whether ties excuse it.
///
/// Where all cells pass, every edge is locally Delaunay, and the cells fit together all around every
/// vertex: the diagram is right.
void checkCells(const ProposedCells& proposed, std::span<const std::uint32_t> which, const Records& records,
                std::span<std::uint8_t> suspect);

/// The same for all cells.
void checkCells(const ProposedCells& proposed, const Records& records, std::span<std::uint8_t> suspect);

/// Whether a cell could be one: certified, of at least three edges, which lead to other sites and walls.
bool isWellFormed(const SiteSet& sites, const NeighborRows& cells, std::size_t cell);

/// Whether `cell` may be empty: certified so, and without edges. A site in the domain has a cell, unless
/// weights hide it, which proveEmpty has proved.
bool isRightlyEmpty(const SiteSet& sites, const NeighborRows& cells, std::size_t cell);

}  // namespace vorpipe::core
