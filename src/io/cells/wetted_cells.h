/// Cells as polygons, of a free surface too.
#pragma once

#include "io/cells/cells_mesh.h"
#include "vorpipe.h"

namespace vorpipe {

/// The parts of cells that lie in the discs around their sites, whose radii are the roots of the weights, as
/// faces of a mesh; each face has points of its own. Arcs are polygons whose corners lie on the circle, so
/// that faces are a little smaller than the cells.
CellsMesh wettedCells(const Sites& sites, const Diagram& diagram);

}  // namespace vorpipe
