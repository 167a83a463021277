/// A mesh of cells as VTK arrays.
#pragma once

#include "io/cells/cells_mesh.h"
#include "io/cells/vtk_xml.h"
#include "vorpipe.h"

namespace vorpipe {

/// The points of a mesh. The results of these three functions refer to their arguments.
VtkSection meshPoints(const CellsMesh& mesh);

/// The corners of the faces, and where those of each face end.
std::vector<VtkArray> meshFaces(const CellsMesh& mesh);

/// For each face, in the diagram of the mesh, the whole cell's site, area, perimeter, neighbors (their
/// number), status (as in .npz) and centroid; weight and mass if there are some.
VtkSection meshData(const CellsMesh& mesh, const Sites& sites, const Diagram& diagram);

}  // namespace vorpipe
