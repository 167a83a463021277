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
  return sink.write({length.data(), length.size()}).and_then([&] {
    return writeEach(sink, array.rows, array.put);
  });
}

}  // namespace

Result<void> writeVtkXml(ByteSink& sink, const VtkPiece& piece) {
  VORPIPE_TRY(sink.write(headerOf(piece)));
  for (const VtkSection& section : piece.sections) {
    for (const VtkArray& array : section.arrays) {
      VORPIPE_TRY(writeArray(sink, array));
    }
  }
  return sink.write("\n</AppendedData>\n</VTKFile>\n");
}

}  // namespace vorpipe
