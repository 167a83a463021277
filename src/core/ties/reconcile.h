/// From proposed cells to cells that agree with each other.
#pragma once

#include "core/search/neighbor_search.h"
#include "core/ties/ties.h"
#include "core/vertices/cell_record.h"

namespace vorpipe::core {

/// Checks all cells and writes their records. Those in dispute are found again, in double and at last
/// exactly, until none is left; `rows` changes accordingly, and `report` counts them. What comes
/// back says where the cells differ from the rows: at ties.
/// Errors: those of the judge; cells that disagree even so.
Result<TiedCells> reconcileCells(const SearchInput& input, NeighborRows& rows, const Records& records,
                                 Report& report);

}  // namespace vorpipe::core
