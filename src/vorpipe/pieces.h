/// The parts of cells in each of several regions.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "vorpipe/cells.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

class Session;  // vorpipe.h

/// Pieces of cells: where the cell of a site and a region meet. Regions are in their given order, sites of a
/// region ascending.
struct Pieces {
  std::vector<std::uint32_t> region, site;  ///< by piece
  /// The pieces as cells: status, area, perimeter, centroid, cell_offsets, vertices, neighbors (sites),
  /// edge_lengths and ring_starts, by piece. Its report is that of all runs; `ok` and `empty` count sites.
  Diagram cells;
  std::vector<double> region_area;  ///< by region: the sum over its pieces

  [[nodiscard]] std::size_t size() const { return site.size(); }
};

/// Receives the cells of one region: the sites that may have a piece of it, in their order, the options of
/// that run, and its diagram. An error ends piecesOf with it.
using EachRegion = std::function<Result<void>(const Sites&, const CellsOptions&, const Diagram&)>;

/// Finds the pieces of cells in valid outlines, which may overlap: each counts for itself. Cells are those of
/// all sites, as `options` asks for them, whose domain holds all regions and which has no outline, period or
/// density. Detail::everything makes the diagrams for `each` as full. Errors: those of Session::cells and
/// `each`.
Result<Pieces> piecesOf(Session& session, const Sites& sites, const CellsOptions& options,
                        std::span<const Outline> regions, const EachRegion& each = {});

}  // namespace vorpipe
