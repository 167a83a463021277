/// What polygons are whose rings cross themselves or each other.
#pragma once

#include <cstddef>

#include "base/geos.h"

namespace vorpipe::core {

/// What the outer ring of a polygon winds around an odd number of times, without what each of its holes does.
/// None where GEOS refuses. Takes time and memory as the edges and their crossings are many.
GeosGeometry repairedPolygon(const Geos& geos, const Outline& outline, std::size_t polygon);

}  // namespace vorpipe::core
