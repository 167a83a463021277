/// Sites along a curve that fills the plane.
#pragma once

#include "backend/backend.h"

namespace vorpipe::core {

/// All sites of a set, so that those near each other in the order are near each other in the plane, however
/// they are spread: the bins along Hilbert's curve, and the sites of a bin along Morton's.
std::vector<std::uint32_t> orderAlongCurve(const SiteSet& sites, int threads);

}  // namespace vorpipe::core
