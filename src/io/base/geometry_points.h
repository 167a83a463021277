/// Points out of a GeoPackage's geometries.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// Appends the points of a geometry: a header by clause 2.1.3 of the standard, then well-known binary, of ISO
/// or with the flags of PostGIS, of either byte order. Empty points append nothing. `others` becomes true
/// where positions have more than x and y. The error is what is wrong: no point, not finite, damaged.
tl::expected<void, std::string> takeGeometryPoints(std::string_view bytes, std::vector<Point>& points,
                                                   bool& others);

}  // namespace vorpipe
