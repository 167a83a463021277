#include <fmt/format.h>

#include "io/cells/cells_file.h"
#include "io/cells/mesh_arrays.h"

namespace vorpipe {
namespace {

/// PolyData, z is 0; faces as in .obj, with the whole cell's data.
Result<void> writeVtpCells(ByteSink& sink, const CellsOutput& output) {
  return cellsMesh(sink, output.diagram).and_then([&](const CellsMesh& mesh) {
    return writeVtkXml(
        sink,
        {"PolyData",
         fmt::format("NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                     "NumberOfPolys=\"{}\"",
                     mesh.points.size(), mesh.size()),
         {meshPoints(mesh), {"Polys", meshFaces(mesh)}, meshData(mesh, output.sites, output.diagram)}});
  });
}

}  // namespace

extern const CellsFormat vtp_cells;
const CellsFormat vtp_cells{
    .extension = ".vtp", .detail = Detail::polygons, .write = writeVtpCells, .mesh = true};

}  // namespace vorpipe
