/// Points from GeoPackage geometries.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// Appends the points of a geometry: a header by clause 2.1.3 of the standard, then well-known binary, by ISO
/// or with PostGIS flags, in either byte order. Empty points append nothing. `others` becomes true if
/// positions have more than x and y. The error states what is wrong: no point, not finite, damaged.
tl::expected<void, std::string> takeGeometryPoints(std::string_view bytes, std::vector<Point>& points,
                                                   bool& others);

}  // namespace vorpipe
