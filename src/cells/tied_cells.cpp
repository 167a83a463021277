#include "cells/tied_cells.h"

#include <algorithm>

#include "base/parallel.h"

namespace vorpipe::core {
namespace {

/// The centroid of a cell, relative to its origin, clamped to the domain: ties may reach slightly beyond a
/// wall, and a cell that only touches the domain may reach far beyond it.
Point centroidInDomain(const SiteSet& sites, Point origin, Point centroid) {
  const Box& domain = sites.domain;
  return {std::clamp(centroid.x, domain.xmin - origin.x, domain.xmax - origin.x),
          std::clamp(centroid.y, domain.ymin - origin.y, domain.ymax - origin.y)};
}

/// Records a cell all of whose edges are ties: its site is nearly hidden, or far outside. Without weights and
/// with an area of 0 up to rounding, the cell only touches the domain, and is empty.
void recordUnedged(const ProposedCells& proposed, std::uint32_t cell, const Records& records) {
  const auto& sites = proposed.sites;
  const auto row = proposed.cells.edges(cell);
  std::vector<AnchoredPoint> corners;
  placeCorners(sites, cell, row, corners);
  const auto origin = measuringOrigin(sites, cell, corners.front());
  const auto m = measureCell(origin, corners);
  const Box& domain = sites.domain;
  const double no_area = 1e-12 * (domain.xmax - domain.xmin) * (domain.ymax - domain.ymin);
  if (sites.weight.empty() && !(m.area > no_area)) return records.empty(cell);
  records.cell(cell, 0, std::max(m.area, 0.0), origin, centroidInDomain(sites, origin, m.centroid),
               std::max(spreadOf(m), 0.0));
}

}  // namespace

void keptEdges(const ProposedCells& proposed, const TiedCells& tied, std::size_t k,
               std::vector<std::uint32_t>& edges) {
  edges.clear();
  const auto row = proposed.cells.edges(tied.cell[k]);
  for (std::uint32_t e = 0; e < row.size(); ++e) {
    if (tied.ties(k)[e] == 0) edges.push_back(e);
  }
  const auto lowest =
      std::min_element(edges.begin(), edges.end(), [&](auto a, auto b) { return row[a] < row[b]; });
  std::rotate(edges.begin(), lowest, edges.end());
}

Measures recordMeasures(const SiteSet& sites, std::uint32_t cell, std::size_t edges,
                        std::span<const AnchoredPoint> corners, const Records& records) {
  const auto origin = measuringOrigin(sites, cell, corners.front());
  const auto m = measureCell(origin, corners);
  records.cell(cell, edges, m.area, origin, centroidInDomain(sites, origin, m.centroid), spreadOf(m));
  return m;
}

void recordTiedCells(const ProposedCells& proposed, const TiedCells& tied, const Records& records) {
  forTiedCells(tied, proposed.threads, [&](std::size_t k) {
    const auto cell = tied.cell[k];
    if (proposed.cells.status(cell) == CellStatus::empty) return records.empty(cell);
    const auto edges = static_cast<std::size_t>(std::ranges::count(tied.ties(k), 0));
    if (edges == 0) return recordUnedged(proposed, cell, records);
    records.setEdges(cell, edges);
  });
}

}  // namespace vorpipe::core
