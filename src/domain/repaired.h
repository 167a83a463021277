/// Repair of polygons whose rings cross themselves or each other.
#pragma once

#include <cstddef>

#include "base/geos.h"

namespace vorpipe::core {

/// Returns the region that a polygon's outer ring winds around an odd number of times, minus the like regions
/// of its holes. Null if GEOS refuses. Time and memory grow with the number of edges and their crossings.
GeosGeometry repairedPolygon(const Geos& geos, const Outline& outline, std::size_t polygon);

}  // namespace vorpipe::core
