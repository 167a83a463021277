/// A mesh of cells as arrays of VTK.
#pragma once

#include "io/cells/cells_file.h"
#include "io/cells/cells_mesh.h"
#include "io/cells/vtk_xml.h"

namespace vorpipe {

/// The points of a mesh. What these three return refers to the mesh and the output.
VtkSection meshPoints(const CellsMesh& mesh);

/// The corners of the faces, and where those of each face end.
std::vector<VtkArray> meshFaces(const CellsMesh& mesh);

/// For each face the whole cell's site, area, perimeter, neighbors (their number), status (as in .npz) and
/// centroid; weight and mass where there are some.
VtkSection meshData(const CellsMesh& mesh, const CellsOutput& output);

}  // namespace vorpipe
