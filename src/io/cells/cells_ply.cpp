#include "base/try.h"
#include "io/base/byte_order.h"
#include "io/base/print.h"
#include "io/cells/cells_file.h"
#include "io/cells/cells_mesh.h"

namespace vorpipe {
namespace {

template <class Number>
void append(Bytes& bytes, Number number) {
  appendNumber<std::endian::little>(bytes, number);
}

/// Binary, little-endian, z is 0; faces, as in .obj, have vertex_indices, site and
/// area, the whole cell's.
Result<void> writePlyCells(ByteSink& sink, const CellsOutput& output) {
  const Diagram& diagram = output.diagram;
  const auto mesh = cellsMesh(sink, diagram);
  if (!mesh) {
    return tl::unexpected(mesh.error());
  }
  // A cell may have more vertices than the usual uchar can count.
  const std::string head = fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uint int vertex_indices\nproperty uint site\nproperty double area\n"
      "end_header\n",
      mesh->points.size(), mesh->size());
  VORPIPE_TRY(sink.write(head));
  auto points = writeEach(sink, mesh->points.size(), [&](Bytes& bytes, std::size_t i) {
    append(bytes, mesh->points[i].x);
    append(bytes, mesh->points[i].y);
    append(bytes, 0.0);
  });
  if (!points) {
    return points;
  }
  return writeEach(sink, mesh->size(), [&](Bytes& bytes, std::size_t face) {
    const auto corners = mesh->cornersOf(face);
    append(bytes, static_cast<std::uint32_t>(corners.size()));
    for (const std::int32_t corner : corners) {
      append(bytes, corner);
    }
    append(bytes, mesh->sites[face]);
    append(bytes, diagram.area[mesh->sites[face]]);
  });
}

}  // namespace

extern const CellsFormat ply_cells;
const CellsFormat ply_cells{
    .extension = ".ply", .detail = Detail::polygons, .write = writePlyCells, .mesh = true};

}  // namespace vorpipe
