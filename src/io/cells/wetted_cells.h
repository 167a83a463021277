/// Cells as polygons, including those with a free surface.
#pragma once

#include "io/cells/cells_mesh.h"
#include "vorpipe.h"

namespace vorpipe {

/// Returns the parts of cells inside the discs around their sites as faces of a mesh; each face has points of
/// its own. Radii are the square roots of the weights. Polygons with corners on the circle replace arcs, so
/// faces are a little smaller than the cells.
CellsMesh wettedCells(const Sites& sites, const Diagram& diagram);

}  // namespace vorpipe
