#include "io/cells/cells_file.h"

#include <array>
#include <cassert>
#include <new>

#include "io/base/error.h"
#include "io/base/format_list.h"

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
constexpr std::array cells_formats{CELLS_FORMATS(LISTED)};
#undef LISTED
constexpr std::span<const CellsFormat* const> all_cells_formats(cells_formats);

}  // namespace

std::vector<std::string_view> cellsExtensions() { return extensionsOf(all_cells_formats); }

Result<const CellsFormat*> cellsFormatOf(const std::string& path) {
  return formatFor(path, "cells", all_cells_formats);
}

Result<void> writeCells(ByteSink& sink, const CellsOutput& output, const CellsFormat& format) {
  [[maybe_unused]] const Diagram& diagram = output.diagram;
  assert(diagram.status.size() == output.sites.size());
  assert(diagram.cell_offsets.size() == output.sites.size() + 1);
  assert(format.detail == Detail::measures || diagram.vertices.size() == diagram.cell_offsets.back());
  try {
    return format.write(sink, output);
  } catch (const std::bad_alloc&) {
    return deviceError(sink.name() + ": there is not enough memory to write its cells");
  }
}

}  // namespace vorpipe
