#include "io/cells/cells_file.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <new>

#include "io/files/error.h"
#include "io/files/extension.h"

namespace vorpipe {

// One line for each kind of file: the name of what cells_NAME.cpp defines, NAME_cells.
// clang-format off
#define CELLS_FORMATS(format) \
  format(csv)                 \
  format(npz)                 \
  format(geojson)             \
  format(geojsonl)            \
  format(gpkg)                \
  format(svg)                 \
  format(obj)                 \
  format(ply)                 \
  format(vtk)                 \
  format(vtp)                 \
  format(vtu)                 \
  format(wkt)
// clang-format on

#define DECLARED(name) extern const CellsFormat name##_cells;
CELLS_FORMATS(DECLARED)
#undef DECLARED

namespace {

#define LISTED(name) &name##_cells,
constexpr std::array formats{CELLS_FORMATS(LISTED)};
#undef LISTED

}  // namespace

std::vector<std::string_view> cellsExtensions() {
  std::vector<std::string_view> extensions;
  for (const CellsFormat* format : formats) extensions.push_back(format->extension);
  return extensions;
}

Result<const CellsFormat*> cellsFormatOf(const std::string& path) {
  const std::string extension = lowerExtension(path);
  const auto found = std::ranges::find_if(
      formats, [&](const CellsFormat* format) { return format->extension == extension; });
  if (found != formats.end()) return *found;
  return inputError(fmt::format("{}: unknown kind of file for cells; known are {}", path,
                                fmt::join(cellsExtensions(), ", ")));
}

Result<void> writeCells(ByteSink& sink, const CellsOutput& output, const CellsFormat& format) {
  const Diagram& diagram = output.diagram;
  assert(diagram.status.size() == output.sites.size());
  assert(diagram.cell_offsets.size() == output.sites.size() + 1);
  assert(diagram.vertices.size() == diagram.cell_offsets.back());
  try {
    return format.write(sink, output);
  } catch (const std::bad_alloc&) {
    return deviceError(sink.name() + ": there is not enough memory to write its cells");
  }
}

}  // namespace vorpipe
