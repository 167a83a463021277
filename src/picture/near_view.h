/// Finds the cells that a view can show.
#pragma once

#include <cstdint>
#include <vector>

#include "backend/site_set.h"

namespace vorpipe::core {

/// Returns sites whose cells may reach into a box, ascending: all that do, and some that do not. The power of
/// a place in the box to its site is bounded: by that of a nearby place to any site, plus what the way
/// between the places adds. So a few places bound the distance of relevant sites.
std::vector<std::uint32_t> sitesNear(const SiteSet& sites, const Box& box);

}  // namespace vorpipe::core
