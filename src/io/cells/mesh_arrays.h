/// A mesh of cells as arrays of VTK.
#pragma once

#include "io/cells/cells_mesh.h"
#include "io/cells/vtk_xml.h"
#include "vorpipe.h"

namespace vorpipe {

/// The points of a mesh. What these three return refers to what they are given.
VtkSection meshPoints(const CellsMesh& mesh);

/// The corners of the faces, and where those of each face end.
std::vector<VtkArray> meshFaces(const CellsMesh& mesh);

/// For each face, of the diagram that the mesh is of, the whole cell's site, area, perimeter, neighbors
/// (their number), status (as in .npz) and centroid; weight and mass where there are some.
VtkSection meshData(const CellsMesh& mesh, const Sites& sites, const Diagram& diagram);

}  // namespace vorpipe
