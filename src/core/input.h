/// What is refused before anything is computed.
#pragma once

#include "vorpipe.h"

namespace vorpipe {

/// The part of checkInput that prepare and placeSites leave to it: search, outline and density.
Result<void> checkOptions(const Sites& sites, const CellsOptions& options);

}  // namespace vorpipe
