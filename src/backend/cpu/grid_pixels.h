/// The site nearest to each pixel's center, by the grid that sites stand in: a pixel has few bins to look at,
/// and the one beside it says which.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "backend/backend.h"

namespace vorpipe::cpu {

/// Writes the index in the set of the nearest site for pixels of the view, as nearestSites() does, but for
/// those that are returned, ascending: where sites crowd, or are far, or two are as near but for rounding.
/// All are, where sites have weights or some are hidden.
std::vector<std::uint32_t> nearestOnGrid(const SiteSet& sites, const View& view, int threads,
                                         std::span<std::uint32_t> out);

}  // namespace vorpipe::cpu
