/// What is refused before anything is computed.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

/// The part of checkInput that prepare and placeSites leave to it: search, outline, density, and a domain
/// whose area, or those of cells in it, a double does not hold: they would be infinite, or 0; or that is too
/// flat.
Result<void> checkOptions(const Sites& sites, const CellsOptions& options);

}  // namespace vorpipe::core
