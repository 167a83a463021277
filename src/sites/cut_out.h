/// The sites of some bins as a set of their own.
#pragma once

#include "sites/grid.h"

namespace vorpipe::core {

/// The sites of a block of bins as a set of its own; `coverage` is the block, but that of the set where it
/// ends with the grid. whole[i] is the index in `sites` of its site i. Heavy sites from elsewhere are in the
/// set, but in none of its bins.
SiteSet cutOut(const SiteSet& sites, const BinBlock& block, std::vector<std::uint32_t>& whole);

}  // namespace vorpipe::core
