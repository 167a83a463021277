/// From sites in the caller's order to unique sites in the same order.
#pragma once

#include "sites/bin_sort.h"

namespace vorpipe::core {

/// Fills x, y and id of `set`, and a grid of one bin with all sites, for who searches in no bins: however the
/// sites are crowded, it takes the same time. Duplicates and `owner` are as in orderByBins.
void keepDistinct(const Sites& sites, const PowerOfTwo& scale, int threads, SiteSet& set,
                  std::vector<std::uint32_t>& owner);

}  // namespace vorpipe::core
