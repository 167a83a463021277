/// Which cells a view can show.
#pragma once

#include <cstdint>
#include <vector>

#include "backend/backend.h"

namespace vorpipe::core {

/// The sites whose cells may reach into a box, ascending; all that do are among them, and some that do not.
/// The set has no weights. A place of the box is no farther from its nearest site than a place nearby is from
/// any site, and the way between them: so few places bound how far away the sites are that matter.
std::vector<std::uint32_t> sitesNear(const SiteSet& sites, const Box& box, int threads);

}  // namespace vorpipe::core
