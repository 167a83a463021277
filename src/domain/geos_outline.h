/// Conversion of outlines to GEOS, and back.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/geos.h"

namespace vorpipe::core {

/// One polygon of an outline whose rings have points; null if GEOS refuses.
GeosGeometry polygonOf(const Geos& geos, const Outline& outline, std::size_t polygon);

/// All polygons of an outline together; null if GEOS refuses.
GeosGeometry geometryOf(const Geos& geos, const Outline& outline);

/// Adds the polygons of a geometry, which may be a collection, or null. Ignores points and lines in it.
/// Returns false if GEOS refused.
bool addPolygons(const Geos& geos, const GEOSGeometry* geometry, Outline& outline);

/// Returns what makes a geometry invalid, and where: "Self-intersection at (0.5, 0.5)", or the position
/// converted by `place`; nothing if it is valid. Error (input): GEOS failed, or the geometry is null.
Result<std::optional<std::string>> faultOf(const Geos& geos, const GEOSGeometry* geometry,
                                           const std::function<Point(Point)>& place = {});

/// The first part of checkOutline: checks offsets, numbers of points, and their size. The outline is not
/// empty.
Result<void> checkRings(const Outline& outline);

}  // namespace vorpipe::core
