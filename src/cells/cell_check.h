/// Checks proposed cells against each other, and measures those that pass.
#pragma once

#include <span>
#include <vector>

#include "cells/cell_record.h"
#include "cells/edge_index.h"

namespace vorpipe::core {

/// Cells as they were found, and what their check needs; all of it outlives the use.
struct ProposedCells {
  const SiteSet& sites;
  const NeighborRows& cells;
  const EdgeIndex& index;
  int threads;
};

/// Checks the cells `which` in double. A cell passes where each edge is longer than a tie and both cells of
/// each edge name the same sites and walls at its ends; then it is measured into `records`. Other cells, and
/// those beside a tie, are marked with 1 in `suspect`, which has an element for each cell. resolveTies
/// decides whether ties explain them.
///
/// Where all cells pass, every edge is locally Delaunay and the cells around every vertex agree: the diagram
/// is correct.
void checkCells(const ProposedCells& proposed, std::span<const std::uint32_t> which, const Records& records,
                std::span<std::uint8_t> suspect);

/// The same for all cells.
void checkCells(const ProposedCells& proposed, const Records& records, std::span<std::uint8_t> suspect);

/// Whether a cell is certified and has at least three edges, all to other sites or to walls of the domain.
bool isWellFormed(const SiteSet& sites, const NeighborRows& cells, std::size_t cell);

/// Whether `cell` is correctly empty: status empty, no edges, and its site is outside the domain or has
/// weights, where proveEmpty has checked it. A site in the domain without weights has a cell.
bool isRightlyEmpty(const SiteSet& sites, const NeighborRows& cells, std::size_t cell);

}  // namespace vorpipe::core
