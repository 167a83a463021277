/// Finds the site nearest to each pixel's center on the grid of the sites. A pixel needs only few bins, and
/// the pixel beside it determines which.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "backend/backend.h"

namespace vorpipe::cpu {

/// Writes the index in the set of the nearest site for pixels of the view, as nearestSites() does. Leaves
/// some pixels out and returns them, ascending: where sites crowd or are far, or where two are equally near
/// up to rounding. Leaves all out if sites have weights or some are hidden.
std::vector<std::uint32_t> nearestOnGrid(const SiteSet& sites, const View& view, int threads,
                                         std::span<std::uint32_t> out);

}  // namespace vorpipe::cpu
