/// Cells of sites in a box, measured without being written as polygons.
#pragma once

#include <memory>
#include <optional>

#include "cells/agreed_cells.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// What the last diagram was found with. It stays until the next one: neighbors are written when they are
/// asked for.
struct FoundBox {
  std::unique_ptr<SiteRun> run{};
  std::optional<AgreedCells> cells{};
};

/// Replaces `found` and `moments`, whose arrays are used again. Errors: as Session::cells'.
Result<Report> findMoments(const Machine& machine, const Sites& sites, const CellsOptions& options,
                           FoundBox& found, CellMoments& moments);

/// The same, but where it is proved that a site has no cell, `found` has no cells and `moments` may be of
/// any.
Result<Report> findMomentsUnlessEmpty(const Machine& machine, const Sites& sites, const CellsOptions& options,
                                      FoundBox& found, CellMoments& moments);

/// The neighbors of cells that findMoments() found.
CellsThatMeet neighborsOf(const FoundBox& found, int threads);

}  // namespace vorpipe::core
