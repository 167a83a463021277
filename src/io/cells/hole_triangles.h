/// Polygons with holes as triangles, through GEOS.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "io/cells/cell_rings.h"
#include "vorpipe.h"

namespace vorpipe {

/// Returns counter-clockwise triangles that fill a piece of a cell, using only its vertices; none if GEOS
/// finds that the rings form no polygon.
std::optional<std::vector<std::array<Point, 3>>> trianglesOf(const Diagram& diagram,
                                                             std::span<const Ring> piece);

}  // namespace vorpipe
