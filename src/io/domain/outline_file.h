/// Outlines out of a file of any known kind.
#pragma once

#include <string>

#include "vorpipe.h"

namespace vorpipe {

/// Reads at least one polygon by the path's extension: .geojson or .json is GeoJSON (RFC 7946), a Polygon or
/// MultiPolygon, or a Feature, FeatureCollection or GeometryCollection of nothing else; .wkt is text like
/// POLYGON ((...)) or MULTIPOLYGON (((...))), one or several of them. Of a position x and y are read. Whether
/// rings cross is not looked at. Errors: a path or data that is wrong, with file, line and column, or in
/// GeoJSON the path to the value (input); reading failed or memory ran out (device).
Result<Outline> readOutline(const std::string& path);

}  // namespace vorpipe
