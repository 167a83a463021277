/// The records of cells with ties.
#pragma once

#include "core/ties/ties.h"
#include "core/vertices/cell_record.h"

namespace vorpipe::core {

/// Writes the records of the tied cells, which are not disputed. They are measured as they are before ties
/// join their corners: that moves a vertex by a part of the distance of its sites, which may be much of a
/// thin cell.
void recordTiedCells(const ProposedCells& proposed, const TiedCells& tied, const Records& records);

}  // namespace vorpipe::core
