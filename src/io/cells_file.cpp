#include "io/cells_file.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <array>
#include <cassert>
#include <new>
#include <string_view>
#include <vector>

#include "io/cells_writer.h"
#include "io/error.h"
#include "io/extension.h"

namespace vorpipe {
namespace {

/// In the order of CellsFormat.
constexpr std::array<std::string_view, 8> extensions = {".csv", ".npz", ".geojson", ".svg",
                                                        ".obj", ".ply", ".vtk",     ".wkt"};

Result<void> writeByFormat(OutputFile& file, const Sites& sites, const Diagram& diagram, CellsFormat format) {
  switch (format) {
    case CellsFormat::csv:
      return writeCsvCells(file, sites, diagram);
    case CellsFormat::npz:
      return writeNpzCells(file, sites, diagram);
    case CellsFormat::geojson:
      return writeGeoJsonCells(file, sites, diagram);
    case CellsFormat::svg:
      return writeSvgCells(file, diagram);
    case CellsFormat::obj:
      return writeObjCells(file, diagram);
    case CellsFormat::ply:
      return writePlyCells(file, diagram);
    case CellsFormat::vtk:
      return writeVtkCells(file, diagram);
    case CellsFormat::wkt:
      break;
  }
  return writeWktCells(file, diagram);
}

}  // namespace

Result<CellsFormat> cellsFormatOf(const std::string& path) {
  const std::string extension = lowerExtension(path);
  for (std::size_t i = 0; i < extensions.size(); ++i) {
    if (extension == extensions[i]) {
      return static_cast<CellsFormat>(i);
    }
  }
  return inputError(
      fmt::format("{}: unknown kind of file for cells; known are {}", path, fmt::join(extensions, ", ")));
}

Detail detailOf(CellsFormat format) {
  return format == CellsFormat::npz ? Detail::everything : Detail::polygons;
}

Result<void> writeCells(OutputFile& file, const Sites& sites, const Diagram& diagram, CellsFormat format) {
  assert(diagram.status.size() == sites.size() && diagram.cell_offsets.size() == sites.size() + 1);
  assert(diagram.vertices.size() == diagram.cell_offsets.back());
  try {
    return writeByFormat(file, sites, diagram, format);
  } catch (const std::bad_alloc&) {
    return deviceError(file.name() + ": there is not enough memory to write its cells");
  }
}

}  // namespace vorpipe
