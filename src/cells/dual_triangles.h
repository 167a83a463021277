/// The triangulation that is dual to the cells.
#pragma once

#include "cells/outer_triangles.h"

namespace vorpipe::core {

/// Returns the Delaunay triangulation of all sites (input indices, counter-clockwise from the lowest),
/// whatever the domain; empty if all lie on a line. Uses the mesh's triangles if it is made. Otherwise
/// vertices inside the domain give their triangles; where more than three cells meet, the polygon of their
/// sites is triangulated from its lowest index.
Triangles dualTriangles(const ProposedCells& agreed, const TiedCells& tied, SiteMesh& mesh);

}  // namespace vorpipe::core
