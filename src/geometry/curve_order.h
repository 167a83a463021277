/// Orders sites along a plane-filling curve.
#pragma once

#include <cstdint>
#include <vector>

#include "backend/site_set.h"

namespace vorpipe::core {

/// Sorts sites of a set, given in any order, along Hilbert's curve over their bounding box, so that sites
/// near each other in the order are near each other in the plane, however they are spread. Sites within 2^-32
/// of the box, which the curve cannot distinguish, are sorted along a curve of their own. The order depends
/// only on the sites.
void sortAlongCurve(const SiteSet& sites, std::vector<std::uint32_t>& which, int threads);

}  // namespace vorpipe::core
