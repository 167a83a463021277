/// Sites that may have no cell, to look at before all others.
#pragma once

#include <cstdint>
#include <vector>

#include "backend/backend.h"

namespace vorpipe::core {

/// Some hundred sites inside the domain, ascending: of each run of sites in the order of the set, which are
/// near each other, the one whose bisector with one of the next few sites lies farthest behind it. None
/// without weights.
std::vector<std::uint32_t> likelyEmpty(const SiteSet& sites, int threads);

}  // namespace vorpipe::core
