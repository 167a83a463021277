/// Measures cells of sites in a box without building polygons.
#pragma once

#include <memory>
#include <optional>

#include "cells/agreed_cells.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// Search results of the last diagram. They stay until the next one, since neighbors are written only on
/// request.
struct FoundBox {
  std::unique_ptr<SiteRun> run{};
  std::optional<AgreedCells> cells{};
};

/// Replaces `found` and `moments` and reuses their arrays. For AtEmpty::end `found` has no cells if some site
/// provably has none, and the values of `moments` are unspecified. Errors: those of Session::cells.
Result<Report> findMoments(const Machine& machine, const Sites& sites, const CellsOptions& options,
                           AtEmpty at_empty, FoundBox& found, CellMoments& moments);

/// Returns the neighbors of cells that findMoments() found.
CellsThatMeet neighborsOf(const FoundBox& found, int threads);

}  // namespace vorpipe::core
