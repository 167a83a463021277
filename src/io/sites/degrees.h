/// Whether coordinates are degrees of longitude and latitude.
#pragma once

#include "io/attributes/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// Whether `system` says so; or, where nothing does, whether all sites lie within +-180 and +-90, and reach
/// in x below -90 and above 90.
bool looksLikeDegrees(const Sites& sites, const CoordinateSystem& system);

}  // namespace vorpipe
