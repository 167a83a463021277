/// The only exact tier: finds cells with one tree, pixels with another.
#pragma once

#include <memory>

#include "backend/exact_tier.h"

namespace vorpipe {

/// `threads`: 0 for all processors.
std::unique_ptr<ExactTier> makeExactTier(int threads);

/// The same for places one by one. `sites` must outlive it.
std::unique_ptr<PlaceSearch> makePlaceSearch(const SiteSet& sites, int threads);

}  // namespace vorpipe
