/// Outlines as GEOS has them, and back.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/geos.h"

namespace vorpipe::core {

/// One polygon of an outline whose rings have points; none where GEOS refuses.
GeosGeometry polygonOf(const Geos& geos, const Outline& outline, std::size_t polygon);

/// All polygons of it together; none where GEOS refuses.
GeosGeometry geometryOf(const Geos& geos, const Outline& outline);

/// Adds the polygons of a geometry, which may be a collection, or none. Points and lines in it are left out.
/// False: GEOS refused.
bool addPolygons(const Geos& geos, const GEOSGeometry* geometry, Outline& outline);

/// What makes a geometry invalid, and where: "Self-intersection at (0.5, 0.5)", or where `place` takes it;
/// nothing if it is valid. Error (input): GEOS could not tell, or the geometry is none.
Result<std::optional<std::string>> faultOf(const Geos& geos, const GEOSGeometry* geometry,
                                           const std::function<Point(Point)>& place = {});

/// The part of checkOutline before that: offsets, numbers of points, and their size. The outline is not
/// empty.
Result<void> checkRings(const Outline& outline);

}  // namespace vorpipe::core
