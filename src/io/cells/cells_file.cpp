#include "io/cells/cells_file.h"

#include <array>
#include <cassert>
#include <new>

#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/cells/cells_writers.h"

namespace vorpipe {
namespace {

/// A mesh format.
constexpr CellsFormat meshFormat(std::string_view extension,
                                 Result<void> (*write)(ByteSink& sink, const CellsOutput& output)) {
  return {.extension = extension, .detail = Detail::polygons, .write = write, .mesh = true};
}

/// A format of features, which contains attributes.
constexpr CellsFormat featureFormat(std::string_view extension,
                                    Result<void> (*write)(ByteSink& sink, const CellsOutput& output),
                                    bool in_memory = false) {
  return {.extension = extension,
          .detail = Detail::polygons,
          .write = write,
          .attributes = true,
          .features = true,
          .in_memory = in_memory};
}

constexpr CellsFormat csv_cells{
    .extension = ".csv", .detail = Detail::polygons, .write = writeCsvCells, .attributes = true},
    npz_cells{.extension = ".npz", .detail = Detail::everything, .write = writeNpzCells},
    svg_cells{.extension = ".svg", .detail = Detail::polygons, .write = writeSvgCells},
    wkt_cells{.extension = ".wkt", .detail = Detail::polygons, .write = writeWktCells};
constexpr CellsFormat geojson_cells = featureFormat(".geojson", writeGeojsonCells),
                      geojsonl_cells = featureFormat(".geojsonl", writeGeojsonlCells),
                      gpkg_cells = featureFormat(".gpkg", writeGpkgCells, /*in_memory=*/true);
constexpr CellsFormat obj_cells = meshFormat(".obj", writeObjCells),
                      ply_cells = meshFormat(".ply", writePlyCells),
                      vtk_cells = meshFormat(".vtk", writeVtkCells),
                      vtp_cells = meshFormat(".vtp", writeVtpCells),
                      vtu_cells = meshFormat(".vtu", writeVtuCells);
constexpr std::array cells_formats{&csv_cells,  &npz_cells, &geojson_cells, &geojsonl_cells,
                                   &gpkg_cells, &svg_cells, &obj_cells,     &ply_cells,
                                   &vtk_cells,  &vtp_cells, &vtu_cells,     &wkt_cells};
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
