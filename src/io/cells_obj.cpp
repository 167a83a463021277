#include "io/cell_records.h"
#include "io/cells_mesh.h"
#include "io/cells_writer.h"

namespace vorpipe {

Result<void> writeObjCells(OutputFile& file, const Diagram& diagram) {
  const auto mesh = cellsMesh(file, diagram);
  if (!mesh) {
    return tl::unexpected(mesh.error());
  }
  if (auto written = file.write("# Faces are the cells of the sites that have one, in their order.\n");
      !written) {
    return written;
  }
  auto points = writeEach(file, mesh->points.size(), [&](Bytes& text, std::size_t i) {
    print(text, FMT_COMPILE("v {} {} 0\n"), mesh->points[i].x, mesh->points[i].y);
  });
  if (!points) {
    return points;
  }
  return writeEach(file, mesh->faces.size(), [&](Bytes& text, std::size_t i) {
    text.push_back('f');
    for (const std::int32_t corner : cornersOf(*mesh, diagram, mesh->faces[i])) {
      print(text, FMT_COMPILE(" {}"), corner + 1);
    }
    text.push_back('\n');
  });
}

}  // namespace vorpipe
