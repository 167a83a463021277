/// The triangulation that is dual to the cells.
#pragma once

#include "cells/site_mesh.h"
#include "cells/tied_cells.h"

namespace vorpipe::core {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Returns the Delaunay triangulation of all sites (input indices, counter-clockwise from the lowest),
/// whatever the domain; empty if all lie on a line. Uses the mesh's triangles if it is made. Otherwise
/// vertices inside the domain give their triangles; where more than three cells meet, the polygon of their
/// sites is triangulated from its lowest index.
Triangles dualTriangles(const ProposedCells& agreed, const TiedCells& tied, SiteMesh& mesh);

}  // namespace vorpipe::core
