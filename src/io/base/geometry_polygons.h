/// Polygons out of a GeoPackage's geometries.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// A polygon as a file has it: its outer ring, then its holes, each of which ends where it began.
using PolygonRings = std::vector<std::vector<Point>>;

/// Appends the polygons of a geometry: a Polygon, a MultiPolygon, or a collection of them. Empty ones append
/// nothing. The error is what is wrong: no polygon, not finite, damaged.
tl::expected<void, std::string> takeGeometryPolygons(std::string_view bytes,
                                                     std::vector<PolygonRings>& polygons);

}  // namespace vorpipe
