/// The triangulation that is dual to the cells.
#pragma once

#include "core/corners.h"

namespace vorpipe {

/// The Delaunay triangles (input indices, counter-clockwise) of the vertices inside the domain.
/// Where more than three cells meet, the polygon of their sites is triangulated from its lowest index.
std::vector<std::array<std::uint32_t, 3>> dualTriangles(const SiteSet& sites, const Topology& topology,
                                                        const Corners& corners);

}  // namespace vorpipe
