/// Which cells a view can show.
#pragma once

#include <cstdint>
#include <vector>

#include "backend/backend.h"

namespace vorpipe::core {

/// The sites whose cells may reach into a box, ascending; all that do are among them, and some that do not.
/// The power of no place of the box to its site is more than that of a place nearby to any site, and what the
/// way between them adds: so few places bound how far away the sites are that matter.
std::vector<std::uint32_t> sitesNear(const SiteSet& sites, const Box& box);

}  // namespace vorpipe::core
