#include "io/cells/vtk_xml.h"

#include <fmt/format.h>

#include "base/try.h"

namespace vorpipe {
namespace {

/// Returns the header up to the first array.
std::string headerOf(const VtkPiece& piece) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<{0}>\n<Piece {1}>\n",
      piece.kind, piece.counts);
  std::uint64_t offset = 0;
  for (const VtkSection& section : piece.sections) {
    text += fmt::format("<{}>\n", section.name);
    for (const VtkArray& array : section.arrays) {
      text += fmt::format(
          "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
          "offset=\"{}\"/>\n",
          array.type, array.name, array.components, offset);
      offset += sizeof(std::uint64_t) + array.bytes;
    }
    text += fmt::format("</{}>\n", section.name);
  }
  return text + fmt::format("</Piece>\n</{}>\n<AppendedData encoding=\"raw\">\n_", piece.kind);
}

Result<void> writeArray(ByteSink& sink, const VtkArray& array) {
  Bytes length;
  appendNumber<std::endian::little>(length, array.bytes);
  VORPIPE_TRY(writeAll(sink, length));
  return writeEach(sink, array.rows, array.put);
}

}  // namespace

std::string polyDataCounts(std::uint64_t points, std::uint64_t lines, std::uint64_t polygons) {
  return fmt::format(
      "NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\"",
      points, lines, polygons);
}

Result<void> writeVtkXml(ByteSink& sink, const VtkPiece& piece) {
  VORPIPE_TRY(sink.write(headerOf(piece)));
  for (const VtkSection& section : piece.sections) {
    for (const VtkArray& array : section.arrays) {
      VORPIPE_TRY(writeArray(sink, array));
    }
  }
  return sink.write("\n</AppendedData>\n</VTKFile>\n");
}

VtkSection meshPoints(const CellsMesh& mesh) {
  return {"Points",
          {vtkPoints("Points", mesh.points.size(), [&mesh](std::size_t i) { return mesh.inSpace(i); })}};
}

std::vector<VtkArray> meshFaces(const CellsMesh& mesh) {
  return {vtkNumbers<std::int64_t>("connectivity", mesh.corners.size(),
                                   [&mesh](std::size_t k) { return mesh.corners[k]; }),
          vtkNumbers<std::int64_t>("offsets", mesh.size(),
                                   [&mesh](std::size_t face) { return mesh.offsets[face + 1]; })};
}

Result<void> writeMeshVtp(ByteSink& sink, const CellsMesh& mesh, std::vector<VtkArray> face_data) {
  return writeVtkXml(sink,
                     {"PolyData",
                      polyDataCounts(mesh.points.size(), 0, mesh.size()),
                      {meshPoints(mesh), {"Polys", meshFaces(mesh)}, {"CellData", std::move(face_data)}}});
}

}  // namespace vorpipe
