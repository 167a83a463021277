/// Input checks before any computation.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

/// The checks of checkInput that prepare and placeSites do not make: search, outline, density and domain.
/// Refuses a domain that is too flat, or whose area, or areas of cells in it, would overflow or vanish in a
/// double.
Result<void> checkOptions(const Sites& sites, const CellsOptions& options);

}  // namespace vorpipe::core
