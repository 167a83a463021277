/// Cells that proposals leave in dispute, by exact signs.
#pragma once

#include "space/exact_cell.h"
#include "space/site_bins.h"

namespace vorpipe::space {

/// Returns the exact cell of a site, cut by all sites that can cut it.
ExactCell exactCellOf(const SiteBins& bins, Label site);

}  // namespace vorpipe::space
