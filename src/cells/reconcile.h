/// From proposed cells to cells that agree with each other.
#pragma once

#include "cells/cell_record.h"
#include "cells/neighbor_search.h"
#include "cells/ties.h"

namespace vorpipe::core {

/// Checks all cells and writes their records. Disputed cells are found again, in double and then exactly,
/// until no dispute is left. Updates `rows`; `report` counts what was found again. Returns the cells at ties,
/// which differ from their rows. Errors: those of the judge; exact cells still differ about an edge.
Result<TiedCells> reconcileCells(const SearchInput& input, NeighborRows& rows, const Records& records,
                                 Report& report);

}  // namespace vorpipe::core
