/// Outlines out of one kind of text each. Errors (input) begin with the file's name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

Result<Outline> readGeoJsonOutline(const std::string& name, std::string_view text);
Result<Outline> readWktOutline(const std::string& name, std::string_view text);

/// Adds a ring as a file has it, its first point repeated at its end, to the polygon that was begun last. The
/// error continues "FILE:LINE:COLUMN: ".
tl::expected<void, std::string> addRing(std::vector<Point> points, Outline& outline);

/// Ends a polygon; the rings since the last one are its own.
void endPolygon(Outline& outline);

}  // namespace vorpipe
