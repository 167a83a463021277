/// Reads outlines from one kind of file each. Errors (input) begin with the file's name.
#pragma once

#include <string>
#include <vector>

#include "io/base/input_file.h"
#include "io/sites/outline_file.h"

namespace vorpipe {

Result<OutlineFile> readGeoJsonOutline(InputFile file);
/// One object on each line.
Result<OutlineFile> readGeoJsonLinesOutline(InputFile file);
Result<OutlineFile> readWktOutline(InputFile file);
/// Reads a layer of a database, which is no stream; empty: the only one of polygons.
Result<OutlineFile> readGeoPackageOutline(const std::string& path, const std::string& layer);

/// Adds a ring as in a file, with its first point repeated at its end, to the polygon begun last. The error
/// continues "FILE:LINE:COLUMN: ".
tl::expected<void, std::string> addRing(std::vector<Point> points, Outline& outline);

/// Ends a polygon, which consists of the rings since the last one.
void endPolygon(Outline& outline);

}  // namespace vorpipe
