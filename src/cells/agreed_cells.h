/// The cells of a run, found and agreed on, before they are written as anything.
#pragma once

#include <optional>
#include <span>

#include "cells/site_run.h"
#include "cells/tied_cells.h"

namespace vorpipe::core {

struct AgreedCells {
  NeighborRows rows;
  BigVector<CellRecord> records;  ///< by input index, in the caller's units
  TiedCells tied;
};

/// Finds the cells of a run, which was begun with `sites` on the same machine, and agrees on them. `spread`
/// is as in Records. `report` gets what was done. Errors: as Session::cells'.
Result<AgreedCells> agreeOnCells(const Machine& machine, SiteRun& run, const Sites& sites,
                                 const CellsOptions& options, std::span<double> spread, Report& report);

/// The same, but nothing as soon as it is proved that a site has no cell.
Result<std::optional<AgreedCells>> agreeUnlessEmpty(const Machine& machine, SiteRun& run, const Sites& sites,
                                                    const CellsOptions& options, std::span<double> spread,
                                                    Report& report);

}  // namespace vorpipe::core
