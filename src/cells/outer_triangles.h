/// The part of the triangulation that the domain cuts off.
#pragma once

#include "cells/site_mesh.h"
#include "cells/tied_cells.h"

namespace vorpipe::core {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Completes the triangles of the vertices inside the domain to the Delaunay triangulation of all sites.
void addOuterTriangles(const ProposedCells& agreed, const TiedCells& tied, SiteMesh& mesh,
                       Triangles& triangles);

/// The Delaunay triangulation of all sites without the help of cells, on one thread.
Triangles allTriangles(SiteMesh& mesh);

}  // namespace vorpipe::core
