/// Conversion of outlines to GEOS, and back; refusal of outlines.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "base/geos.h"
#include "base/refusal.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// One polygon of an outline whose rings have points; null if GEOS refuses.
GeosGeometry polygonOf(const Geos& geos, const Outline& outline, std::size_t polygon);

/// All polygons of an outline together; null if GEOS refuses.
GeosGeometry geometryOf(const Geos& geos, const Outline& outline);

/// Adds the polygons of a geometry, which may be a collection, or null. Ignores points and lines in it.
/// Returns false if GEOS refused.
bool addPolygons(const Geos& geos, const GEOSGeometry* geometry, Outline& outline);

/// A collection of this kind; null if any of its parts is, or if GEOS refuses.
GeosGeometry collected(const Geos& geos, int kind, std::vector<GeosGeometry> parts);

/// Stores the position of a point, which may be null. Returns false if GEOS refused.
bool readPoint(const Geos& geos, const GEOSGeometry* point, Point& at);

/// Returns what makes a geometry invalid, and where: "Self-intersection at (0.5, 0.5)", or the position
/// converted by `place`; nothing if it is valid. Error (input): GEOS failed, or the geometry is null.
Result<std::optional<std::string>> faultOf(const Geos& geos, const GEOSGeometry* geometry,
                                           const std::function<Point(Point)>& place = {});

/// The first part of checkOutline: checks offsets, numbers of points, and their size. The outline is not
/// empty.
Result<void> checkRings(const Outline& outline);

/// Returns an error (input) about the outline: `what` is wrong with it.
inline tl::unexpected<Error> refuseOutline(const std::string& what) {
  return tl::unexpected(refusalOf(Subject::outline, what));
}

}  // namespace vorpipe::core
