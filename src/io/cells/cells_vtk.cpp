#include <string_view>

#include "base/try.h"
#include "io/base/byte_order.h"
#include "io/base/print.h"
#include "io/cells/cells_file.h"
#include "io/cells/cells_mesh.h"

namespace vorpipe {
namespace {

template <class Number>
void append(Bytes& bytes, Number number) {
  appendNumber<std::endian::big>(bytes, number);
}

Result<void> writePoints(ByteSink& sink, const CellsMesh& mesh) {
  auto head = sink.write(
      fmt::format("# vtk DataFile Version 3.0\nvorpipe cells\nBINARY\nDATASET POLYDATA\nPOINTS {} double\n",
                  mesh.points.size()));
  if (!head) {
    return head;
  }
  return writeEach(sink, mesh.points.size(), [&](Bytes& bytes, std::size_t i) {
    append(bytes, mesh.points[i].x);
    append(bytes, mesh.points[i].y);
    append(bytes, 0.0);
  });
}

Result<void> writePolygons(ByteSink& sink, const CellsMesh& mesh) {
  auto head = sink.write(fmt::format("\nPOLYGONS {} {}\n", mesh.size(), mesh.size() + mesh.corners.size()));
  if (!head) {
    return head;
  }
  return writeEach(sink, mesh.size(), [&](Bytes& bytes, std::size_t face) {
    const auto corners = mesh.cornersOf(face);
    append(bytes, static_cast<std::int32_t>(corners.size()));
    for (const std::int32_t corner : corners) {
      append(bytes, corner);
    }
  });
}

/// One number for each face; `type` is VTK's name of what `numberOf(site)` returns.
template <class NumberOf>
Result<void> writeCellData(ByteSink& sink, const CellsMesh& mesh, std::string_view name,
                           std::string_view type, const NumberOf& numberOf) {
  VORPIPE_TRY(sink.write(fmt::format("\nSCALARS {} {} 1\nLOOKUP_TABLE default\n", name, type)));
  return writeEach(sink, mesh.size(),
                   [&](Bytes& bytes, std::size_t face) { append(bytes, numberOf(mesh.sites[face])); });
}

/// Legacy format, version 3.0, binary, POLYDATA, z is 0; faces as in .obj; cell data are site, area,
/// perimeter, neighbors (their number) and status (as in .npz), the whole cell's.
Result<void> writeVtkCells(ByteSink& sink, const CellsOutput& output) {
  const Diagram& diagram = output.diagram;
  return cellsMesh(sink, diagram).and_then([&](const CellsMesh& mesh) {
    const auto data = [&](std::string_view name, std::string_view type, const auto& numberOf) {
      return [&, name, type, numberOf] { return writeCellData(sink, mesh, name, type, numberOf); };
    };
    return writePoints(sink, mesh)
        .and_then([&] { return writePolygons(sink, mesh); })
        .and_then([&] { return sink.write(fmt::format("\nCELL_DATA {}", mesh.size())); })
        .and_then(data("site", "unsigned_int", [](std::uint32_t site) { return site; }))
        .and_then(data("area", "double", [&](std::uint32_t site) { return diagram.area[site]; }))
        .and_then(data("perimeter", "double", [&](std::uint32_t site) { return diagram.perimeter[site]; }))
        .and_then(
            data("neighbors", "int",
                 [&](std::uint32_t site) { return static_cast<std::int32_t>(diagram.cell(site).edges()); }))
        .and_then(data("status", "unsigned_char",
                       [&](std::uint32_t site) { return static_cast<unsigned char>(diagram.status[site]); }))
        .and_then([&] { return sink.write("\n"); });
  });
}

}  // namespace

extern const CellsFormat vtk_cells;
const CellsFormat vtk_cells{
    .extension = ".vtk", .detail = Detail::polygons, .write = writeVtkCells, .mesh = true};

}  // namespace vorpipe
