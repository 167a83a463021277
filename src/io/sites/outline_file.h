/// Reads outlines from a file of any known kind.
#pragma once

#include <string>
#include <vector>

#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

struct OutlineFile {
  Outline outline{};
  CoordinateSystem system{};
};

/// The extensions of all kinds, in the order in which messages name them.
std::vector<std::string> outlineExtensions();

/// Reads at least one polygon, by the path's extension (the one before .gz, if any): .geojson or .json is
/// GeoJSON (RFC 7946), a Polygon or MultiPolygon, or a Feature, FeatureCollection or GeometryCollection of
/// nothing else; .geojsonl, .geojsons or .ndjson has one of them on each line; .wkt is text like POLYGON
/// ((...)) or MULTIPOLYGON (((...))), one or several of them, or a GEOMETRYCOLLECTION; .gpkg a GeoPackage, of
/// which `layer` names the layer; empty: its only one of polygons. Reads only x and y of a position. Does not
/// check whether rings cross. The system is from the file or a .prj beside it. Errors: a path or data that is
/// wrong, with file, line and column, or in GeoJSON the path to the value (input); reading failed or memory
/// ran out (device).
Result<OutlineFile> readOutline(const std::string& path, const std::string& layer = {});

}  // namespace vorpipe
