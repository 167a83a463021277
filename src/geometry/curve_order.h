/// Sites along a curve that fills the plane.
#pragma once

#include <cstdint>
#include <vector>

#include "backend/backend.h"

namespace vorpipe::core {

/// Sorts sites of a set, given in any order, along Hilbert's curve over their bounding box, so that those
/// near each other in the order are near each other in the plane, however they are spread. Sites that the
/// curve does not tell apart, 2^-32 of the box, are sorted along a curve of their own. The order depends on
/// nothing but the sites.
void sortAlongCurve(const SiteSet& sites, std::vector<std::uint32_t>& which, int threads);

}  // namespace vorpipe::core
