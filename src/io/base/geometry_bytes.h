/// Points and polygons from the bytes of GeoPackage geometries: a header by clause 2.1.3 of the standard,
/// then well-known binary, by ISO or with PostGIS flags, in either byte order.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// Nesting depth of geometry collections in files, which GeoJSON advises against (RFC 7946, 3.1.8).
inline constexpr int most_nested_collections = 32;

/// A polygon as in a file: its outer ring, then its holes; each ring ends at its first point.
using PolygonRings = std::vector<std::vector<Point>>;

/// Success, or what is wrong with a geometry: its type, a number that is not finite, damage.
using GeometryTaken = tl::expected<void, std::string>;

/// Appends the points of a Point or MultiPoint. Empty points append nothing. `others` becomes true if
/// positions have more than x and y.
GeometryTaken takeGeometryPoints(std::string_view bytes, std::vector<Point>& points, bool& others);

/// Appends the polygons of a Polygon, a MultiPolygon, or a collection of them. Empty ones append nothing.
GeometryTaken takeGeometryPolygons(std::string_view bytes, std::vector<PolygonRings>& polygons);

}  // namespace vorpipe
