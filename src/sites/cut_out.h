/// Extracts the sites of some bins as a separate set.
#pragma once

#include "sites/grid.h"

namespace vorpipe::core {

/// Returns the sites of a block of bins as a separate set. Its `coverage` is the block, except where the
/// block ends with the grid: there it is that of `sites`. whole[i] is the index in `sites` of site i. Heavy
/// sites from elsewhere are in the set, but in none of its bins.
SiteSet cutOut(const SiteSet& sites, const BinBlock& block, std::vector<std::uint32_t>& whole);

}  // namespace vorpipe::core
