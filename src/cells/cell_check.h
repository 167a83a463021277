/// Checks proposed cells against each other, and measures those that pass.
#pragma once

#include <span>
#include <vector>

#include "cells/cell_record.h"
#include "cells/neighbor_rows.h"

namespace vorpipe::core {

/// Cells as found, and what their check needs. The referenced objects outlive it.
struct ProposedCells {
  const SiteSet& sites;
  const NeighborRows& cells;
  const EdgeIndex& index;
  int threads;
};

/// Checks the cells `which` in double. A cell passes if each edge is longer than a tie and both cells of each
/// edge name the same sites and walls at its ends. Cells that pass are measured into `records`. Other cells,
/// and those beside a tie, get 1 in `suspect`, which has an element for each cell. resolveTies decides
/// whether ties explain them.
///
/// If all cells pass, every edge is locally Delaunay and the cells around every vertex agree: the diagram is
/// correct.
void checkCells(const ProposedCells& proposed, std::span<const std::uint32_t> which, const Records& records,
                std::span<std::uint8_t> suspect);

/// The same for all cells.
void checkCells(const ProposedCells& proposed, const Records& records, std::span<std::uint8_t> suspect);

/// Whether a cell is so flat, or turned around, that only exact arithmetic decides whether weights leave it
/// an area: its two longest edges may coincide without being short.
inline bool isFlat(double area, double perimeter) { return !(area > 1e-6 * perimeter * perimeter); }

/// Whether a cell is certified and has at least three edges, all to other sites or to walls of the domain.
bool isWellFormed(const SiteSet& sites, const NeighborRows& cells, std::size_t cell);

/// Whether `cell` is correctly empty: its status is empty, it has no edges, and its site is outside the
/// domain or the set has weights. With weights, proveEmpty has checked it. Without weights, every site in the
/// domain has a cell.
bool isRightlyEmpty(const SiteSet& sites, const NeighborRows& cells, std::size_t cell);

}  // namespace vorpipe::core
