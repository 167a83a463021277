/// Whether coordinates are degrees of longitude and latitude.
#pragma once

#include <string>
#include <string_view>

#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// Whether `system` says so; or, where nothing does, whether all sites lie within +-180 and +-90, and reach
/// in x below -90 and above 90.
bool looksLikeDegrees(const Sites& sites, const CoordinateSystem& system);

/// What helps where a box from `west` to `east` may be meant across the antimeridian, in words that continue
/// a refusal; else nothing.
std::string hintAcrossAntimeridian(double west, double east);

/// Takes back that `system` is one of degrees where a site reaches beyond 360 or 90 of them. Returns what to
/// say of it, in words that continue the name of the sites; empty: nothing was changed.
std::string_view settleDegrees(const Sites& sites, CoordinateSystem& system);

}  // namespace vorpipe
