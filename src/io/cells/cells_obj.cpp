#include "base/try.h"
#include "io/base/print.h"
#include "io/cells/cells_file.h"
#include "io/cells/cells_mesh.h"

namespace vorpipe {

namespace {

/// Writes faces in the order of their sites; z is 0. A piece of a cell is a face; one with holes is several
/// triangles. If cells may have several faces, groups site_N hold them.
Result<void> writeObjCells(ByteSink& sink, const CellsOutput& output) {
  const Diagram& diagram = output.diagram;
  const auto mesh = cellsMesh(sink, diagram);
  if (!mesh) {
    return tl::unexpected(mesh.error());
  }
  const bool in_pieces = !diagram.ring_starts.empty();
  const std::string_view head = in_pieces
                                    ? "# Faces are pieces of cells; the group is the cell's site.\n"
                                    : "# Faces are the cells of the sites that have one, in their order.\n";
  VORPIPE_TRY(sink.write(head));
  auto points = writeEach(sink, mesh->points.size(), [&](Bytes& text, std::size_t i) {
    print(text, FMT_COMPILE("v {} {} 0\n"), mesh->points[i].x, mesh->points[i].y);
  });
  if (!points) {
    return points;
  }
  return writeEach(sink, mesh->size(), [&](Bytes& text, std::size_t face) {
    if (in_pieces && (face == 0 || mesh->sites[face] != mesh->sites[face - 1])) {
      print(text, FMT_COMPILE("g site_{}\n"), mesh->sites[face]);
    }
    text.push_back('f');
    for (const std::int32_t corner : mesh->cornersOf(face)) {
      print(text, FMT_COMPILE(" {}"), corner + 1);
    }
    text.push_back('\n');
  });
}

}  // namespace

extern const CellsFormat obj_cells;
const CellsFormat obj_cells{
    .extension = ".obj", .detail = Detail::polygons, .write = writeObjCells, .mesh = true};

}  // namespace vorpipe
