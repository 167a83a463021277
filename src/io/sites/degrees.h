/// Whether coordinates are degrees of longitude and latitude.
#pragma once

#include <string>
#include <string_view>

#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// Whether `system` is degrees. If it is unknown: whether all sites lie within +-180 and +-90, and their x
/// reach below -90 and above 90.
bool looksLikeDegrees(const Sites& sites, const CoordinateSystem& system);

/// Returns advice if a box from `west` to `east` may be meant across the antimeridian, in words that continue
/// a refusal; else nothing.
std::string hintAcrossAntimeridian(double west, double east);

/// Withdraws that `system` is degrees if a site exceeds 360 or 90 of them. Returns a note that continues the
/// name of the sites; empty if nothing changed.
std::string_view settleDegrees(const Sites& sites, CoordinateSystem& system);

}  // namespace vorpipe
