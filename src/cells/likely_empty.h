/// Sites that may have no cell, to be checked before all others.
#pragma once

#include <cstdint>
#include <vector>

#include "backend/backend.h"

namespace vorpipe::core {

/// Returns some hundred sites inside the domain, ascending; none without weights. Consecutive sites in the
/// set are near each other. From each run of them, takes the site whose bisector with one of the next few
/// sites lies farthest behind it.
std::vector<std::uint32_t> likelyEmpty(const SiteSet& sites, int threads);

}  // namespace vorpipe::core
