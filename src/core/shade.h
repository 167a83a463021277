/// Which of a palette's 256 colors each site gets.
#pragma once

#include "backend/backend.h"
#include "core/flann_search.h"

namespace vorpipe {

/// Returns a palette index by site in the set. By site: 256 i / (n + 1), as in the thesis
/// (Listing A.2), i the input index of n. By area, neighbors or weight: linear from the least to the
/// greatest. Area and neighbors are those of the cells in double.
/// Errors: color by weight of sites without weights (input); those of the judge.
Result<std::vector<std::uint8_t>> shadesOf(ColorBy color, const Sites& sites, const SiteSet& set,
                                           const FlannSearch& search, Backend& judge, int threads,
                                           const Progress& progress);

}  // namespace vorpipe
