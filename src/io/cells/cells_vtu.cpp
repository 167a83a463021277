#include <fmt/format.h>

#include <utility>

#include "io/cells/cells_file.h"
#include "io/cells/mesh_arrays.h"

namespace vorpipe {
namespace {

/// UnstructuredGrid, z is 0; faces as in .obj, with the whole cell's data.
Result<void> writeVtuCells(ByteSink& sink, const CellsOutput& output) {
  return cellsMesh(sink, output.diagram).and_then([&](const CellsMesh& mesh) {
    constexpr std::uint8_t polygon = 7;  // VTK_POLYGON
    auto faces = meshFaces(mesh);
    faces.push_back(vtkNumbers<std::uint8_t>("types", mesh.size(), [](std::size_t) { return polygon; }));
    return writeVtkXml(
        sink,
        {"UnstructuredGrid",
         fmt::format("NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", mesh.points.size(), mesh.size()),
         {meshPoints(mesh), {"Cells", std::move(faces)}, meshData(mesh, output.sites, output.diagram)}});
  });
}

}  // namespace

extern const CellsFormat vtu_cells;
const CellsFormat vtu_cells{
    .extension = ".vtu", .detail = Detail::polygons, .write = writeVtuCells, .mesh = true};

}  // namespace vorpipe
