/// Reads outlines from a file of any known kind.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

struct OutlineFile {
  Outline outline{};
  CoordinateSystem system{};
  /// Feature f of the file has the polygons feature_polygons[f] .. feature_polygons[f + 1] - 1 of the
  /// outline.
  std::vector<std::uint64_t> feature_polygons{};
  std::vector<Attribute> attributes{};  ///< of the features
};

/// Whether to read attributes of features.
enum class FeatureAttributes : std::uint8_t { dropped, kept };

/// The extensions of all kinds, in the order in which messages name them.
std::vector<std::string> outlineExtensions();

/// Reads at least one polygon, by the path's extension (the one before .gz, if any): .geojson or .json is
/// GeoJSON (RFC 7946), a Polygon or MultiPolygon, or a Feature, FeatureCollection or GeometryCollection of
/// nothing else; .geojsonl, .geojsons or .ndjson has one of them on each line; .wkt is text like POLYGON
/// ((...)) or MULTIPOLYGON (((...))), one or several of them, or a GEOMETRYCOLLECTION; .gpkg a GeoPackage, of
/// which `layer` names the layer; empty: its only one of polygons; .shp a shapefile, by GDAL's ogr2ogr. Reads
/// only x and y of a position. Does not check whether rings cross. The system is from the file or a .prj
/// beside it. Errors: a path or data that is wrong, with file, line and column, or in GeoJSON the path to the
/// value (input); reading failed or memory ran out (device).
Result<OutlineFile> readOutline(const std::string& path, const std::string& layer = {},
                                FeatureAttributes attributes = FeatureAttributes::dropped);

/// Parts of an outline by a name that their features have.
struct NamedOutlines {
  Attribute names;                ///< by part
  std::vector<Outline> outlines;  ///< by part
  std::uint64_t same = 0;         ///< features that have the name of one before them
  std::uint64_t empty = 0;        ///< features without polygons, which are left out
};

/// Returns the features that have polygons, in their order; those of one name are one part, and so are those
/// without a name. Error (input): there is no such attribute.
Result<NamedOutlines> outlinesBy(const OutlineFile& file, const std::string& name);

}  // namespace vorpipe
