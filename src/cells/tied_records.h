/// The records of cells with ties.
#pragma once

#include "cells/cell_record.h"
#include "cells/tied_cells.h"

namespace vorpipe::core {

/// Measures a tied cell with its own corners, before ties join these: joining moves a vertex by up to a tie,
/// which may be long relative to a thin cell.
Measures recordMeasures(const SiteSet& sites, std::uint32_t cell, std::size_t edges,
                        std::span<const AnchoredPoint> corners, const Records& records);

/// Completes the records of the tied cells with the number of edges that ties leave. None of the cells is
/// disputed.
void recordTiedCells(const ProposedCells& proposed, const TiedCells& tied, const Records& records);

}  // namespace vorpipe::core
