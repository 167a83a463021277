// Cells as meshes: .obj, .ply, .vtk, .vtp and .vtu.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/print.h"
#include "io/cells/cells_mesh.h"
#include "io/cells/cells_writers.h"
#include "io/cells/vtk_xml.h"

namespace vorpipe {
namespace {

/// Appends x, y and z.
template <std::endian order>
void appendPoint(Bytes& bytes, const Point3& point) {
  for (const double number : {point.x, point.y, point.z}) appendNumber<order>(bytes, number);
}

/// Whether cells may be several faces.
bool isInPieces(const CellsMesh& mesh, const Diagram& diagram) {
  const bool on_globe = !mesh.heights.empty();
  return on_globe ? std::ranges::adjacent_find(mesh.sites) != mesh.sites.end() : !diagram.ring_starts.empty();
}

Result<CellsMesh> meshOf(const ByteSink& sink, const CellsOutput& output) {
  if (output.system.on_globe) return globeMesh(sink, output.sites, output.diagram);
  return cellsMesh(sink, output.diagram);
}

/// Appends a face's number of corners, as a Count, and its corners.
template <std::endian order, class Count>
void appendFace(Bytes& bytes, const CellsMesh& mesh, std::size_t face) {
  const auto corners = mesh.cornersOf(face);
  appendNumber<order>(bytes, static_cast<Count>(corners.size()));
  for (const std::int32_t corner : corners) appendNumber<order>(bytes, corner);
}

Result<void> writeObj(ByteSink& sink, const CellsMesh& mesh, bool in_pieces) {
  VORPIPE_TRY(sink.write(in_pieces ? "# Faces are pieces of cells; the group is the cell's site.\n"
                                   : "# Faces are the cells of the sites that have one, in their order.\n"));
  VORPIPE_TRY(writeEach(sink, mesh.points.size(), [&](Bytes& text, std::size_t i) {
    const Point3 point = mesh.inSpace(i);
    print(text, FMT_COMPILE("v {} {} {}\n"), point.x, point.y, point.z);
  }));
  return writeEach(sink, mesh.size(), [&](Bytes& text, std::size_t face) {
    if (in_pieces && (face == 0 || mesh.sites[face] != mesh.sites[face - 1])) {
      print(text, FMT_COMPILE("g site_{}\n"), mesh.sites[face]);
    }
    text.push_back('f');
    for (const std::int32_t corner : mesh.cornersOf(face)) print(text, FMT_COMPILE(" {}"), corner + 1);
    text.push_back('\n');
  });
}

Result<void> writePly(ByteSink& sink, const CellsMesh& mesh, const Diagram& diagram) {
  constexpr auto order = std::endian::little;
  // A cell may have more vertices than the usual uchar can count.
  VORPIPE_TRY(sink.write(fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uint int vertex_indices\nproperty uint site\nproperty double area\n"
      "end_header\n",
      mesh.points.size(), mesh.size())));
  VORPIPE_TRY(writeEach(sink, mesh.points.size(),
                        [&](Bytes& bytes, std::size_t i) { appendPoint<order>(bytes, mesh.inSpace(i)); }));
  return writeEach(sink, mesh.size(), [&](Bytes& bytes, std::size_t face) {
    appendFace<order, std::uint32_t>(bytes, mesh, face);
    appendNumber<order>(bytes, mesh.sites[face]);
    appendNumber<order>(bytes, diagram.area[mesh.sites[face]]);
  });
}

Result<void> writeVtk(ByteSink& sink, const CellsMesh& mesh, const Diagram& diagram) {
  constexpr auto order = std::endian::big;
  VORPIPE_TRY(sink.write(
      fmt::format("# vtk DataFile Version 3.0\nvorpipe cells\nBINARY\nDATASET POLYDATA\nPOINTS {} double\n",
                  mesh.points.size())));
  VORPIPE_TRY(writeEach(sink, mesh.points.size(),
                        [&](Bytes& bytes, std::size_t i) { appendPoint<order>(bytes, mesh.inSpace(i)); }));
  VORPIPE_TRY(sink.write(fmt::format("\nPOLYGONS {} {}\n", mesh.size(), mesh.size() + mesh.corners.size())));
  VORPIPE_TRY(writeEach(sink, mesh.size(), [&](Bytes& bytes, std::size_t face) {
    appendFace<order, std::int32_t>(bytes, mesh, face);
  }));
  VORPIPE_TRY(sink.write(fmt::format("\nCELL_DATA {}", mesh.size())));
  // One number for each face; `type` is VTK's name of what `numberOf(site)` returns.
  const auto data = [&](std::string_view name, std::string_view type, const auto& numberOf) -> Result<void> {
    VORPIPE_TRY(sink.write(fmt::format("\nSCALARS {} {} 1\nLOOKUP_TABLE default\n", name, type)));
    return writeEach(sink, mesh.size(), [&](Bytes& bytes, std::size_t face) {
      appendNumber<order>(bytes, numberOf(mesh.sites[face]));
    });
  };
  VORPIPE_TRY(data("site", "unsigned_int", [](std::uint32_t site) { return site; }));
  VORPIPE_TRY(data("area", "double", [&](std::uint32_t site) { return diagram.area[site]; }));
  VORPIPE_TRY(data("perimeter", "double", [&](std::uint32_t site) { return diagram.perimeter[site]; }));
  VORPIPE_TRY(data("neighbors", "int", [&](std::uint32_t site) {
    return static_cast<std::int32_t>(diagram.cell(site).edges());
  }));
  VORPIPE_TRY(data("status", "unsigned_char",
                   [&](std::uint32_t site) { return static_cast<unsigned char>(diagram.status[site]); }));
  return sink.write("\n");
}

/// For each face the whole cell's site, area, perimeter, neighbors (their number), status (as in .npz) and
/// centroid; weight and mass if there are some.
std::vector<VtkArray> faceData(const CellsMesh& mesh, const Sites& sites, const Diagram& diagram) {
  const auto numbers = [&mesh](std::string_view name, const std::vector<double>& by_site) {
    return vtkNumbers<double>(name, mesh.size(), [&](std::size_t face) { return by_site[mesh.sites[face]]; });
  };
  std::vector<VtkArray> data;
  data.push_back(
      vtkNumbers<std::uint32_t>("site", mesh.size(), [&](std::size_t face) { return mesh.sites[face]; }));
  data.push_back(numbers("area", diagram.area));
  data.push_back(numbers("perimeter", diagram.perimeter));
  data.push_back(vtkNumbers<std::int64_t>(
      "neighbors", mesh.size(), [&](std::size_t face) { return diagram.cell(mesh.sites[face]).edges(); }));
  data.push_back(vtkNumbers<std::uint8_t>(
      "status", mesh.size(), [&](std::size_t face) { return diagram.status[mesh.sites[face]]; }));
  const auto centroidOf = [&](std::size_t face) { return diagram.centroid[mesh.sites[face]]; };
  const bool on_globe = !mesh.heights.empty();
  data.push_back(on_globe ? vtkPoints("centroid", mesh.size(),
                                      [centroidOf](std::size_t face) { return onGlobe(centroidOf(face)); })
                          : vtkPoints("centroid", mesh.size(), centroidOf));
  if (!sites.weight.empty()) data.push_back(numbers("weight", sites.weight));
  if (!diagram.mass.empty()) data.push_back(numbers("mass", diagram.mass));
  return data;
}

Result<void> writeVtu(ByteSink& sink, const CellsMesh& mesh, std::vector<VtkArray> face_data) {
  constexpr std::uint8_t polygon = 7;  // VTK_POLYGON
  auto faces = meshFaces(mesh);
  faces.push_back(vtkNumbers<std::uint8_t>("types", mesh.size(), [](std::size_t) { return polygon; }));
  return writeVtkXml(
      sink, {"UnstructuredGrid",
             fmt::format("NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", mesh.points.size(), mesh.size()),
             {meshPoints(mesh), {"Cells", std::move(faces)}, {"CellData", std::move(face_data)}}});
}

}  // namespace

Result<void> writeObjCells(ByteSink& sink, const CellsOutput& output) {
  return meshOf(sink, output).and_then([&](const CellsMesh& mesh) {
    return writeObj(sink, mesh, isInPieces(mesh, output.diagram));
  });
}

Result<void> writePlyCells(ByteSink& sink, const CellsOutput& output) {
  return meshOf(sink, output).and_then([&](const CellsMesh& mesh) {
    return writePly(sink, mesh, output.diagram);
  });
}

Result<void> writeVtkCells(ByteSink& sink, const CellsOutput& output) {
  return meshOf(sink, output).and_then([&](const CellsMesh& mesh) {
    return writeVtk(sink, mesh, output.diagram);
  });
}

Result<void> writeVtpCells(ByteSink& sink, const CellsOutput& output) {
  return meshOf(sink, output).and_then([&](const CellsMesh& mesh) {
    return writeMeshVtp(sink, mesh, faceData(mesh, output.sites, output.diagram));
  });
}

Result<void> writeVtuCells(ByteSink& sink, const CellsOutput& output) {
  return meshOf(sink, output).and_then([&](const CellsMesh& mesh) {
    return writeVtu(sink, mesh, faceData(mesh, output.sites, output.diagram));
  });
}

}  // namespace vorpipe
