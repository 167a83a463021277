/// Outlines out of one kind of text each. Errors (input) begin with the file's name.
#pragma once

#include <string>
#include <vector>

#include "io/files/input_file.h"

namespace vorpipe {

Result<Outline> readGeoJsonOutline(InputFile& file);
Result<Outline> readWktOutline(InputFile& file);

/// Adds a ring as a file has it, its first point repeated at its end, to the polygon that was begun last. The
/// error continues "FILE:LINE:COLUMN: ".
tl::expected<void, std::string> addRing(std::vector<Point> points, Outline& outline);

/// Ends a polygon; the rings since the last one are its own.
void endPolygon(Outline& outline);

}  // namespace vorpipe
