/// The records of cells with ties.
#pragma once

#include "core/ties/tied_cells.h"
#include "core/vertices/cell_record.h"

namespace vorpipe::core {

/// Writes the records of the tied cells, none of which is disputed. They are measured with their own corners,
/// before ties join these: joining moves a vertex by up to a tie, which may be long relative to a thin
/// cell.
void recordTiedCells(const ProposedCells& proposed, const TiedCells& tied, const Records& records);

}  // namespace vorpipe::core
