/// Polygons from GeoPackage geometries.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// A polygon as in a file: its outer ring, then its holes; each ring ends at its first point.
using PolygonRings = std::vector<std::vector<Point>>;

/// Appends the polygons of a geometry: a Polygon, a MultiPolygon, or a collection of them. Empty ones append
/// nothing. The error states what is wrong: no polygon, not finite, damaged.
tl::expected<void, std::string> takeGeometryPolygons(std::string_view bytes,
                                                     std::vector<PolygonRings>& polygons);

}  // namespace vorpipe
