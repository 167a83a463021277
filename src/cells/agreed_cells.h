/// The cells of a run, found and consistent with each other, and the diagram written from them.
#pragma once

#include <optional>
#include <span>

#include "cells/neighbor_search.h"
#include "cells/site_run.h"
#include "cells/tied_cells.h"

namespace vorpipe::core {

struct AgreedCells {
  NeighborRows rows;
  BigVector<CellRecord> records;  ///< by input index, in the caller's units
  TiedCells tied;
};

/// Finds the cells of a run and makes them agree. The run was begun with `sites` on the same machine.
/// `spread` is as in Records. Adds what was done to `report`. Returns nothing only for AtEmpty::end. Errors:
/// as in Session::cells.
Result<std::optional<AgreedCells>> agreeOnCells(const Machine& machine, SiteRun& run, const Sites& sites,
                                                const CellsOptions& options, AtEmpty at_empty,
                                                std::span<double> spread, Report& report);

/// Does what Session::cells does, except outlines, periods and mass. `run` was begun with `sites`, on the
/// same machine. Stores the cells in `run` and moves its owners to the diagram. Errors: as in Session::cells.
Result<Diagram> boxDiagramOn(const Machine& machine, SiteRun& run, const Sites& sites,
                             const CellsOptions& options);

}  // namespace vorpipe::core
