#include "cli/cells_notes.h"

#include <fmt/format.h>

#include <string>

#include "cli/options/error_line.h"
#include "io/base/extension.h"
#include "io/cells/cell_attributes.h"
#include "io/cells/cell_polygons.h"

namespace vorpipe::cli {
namespace {

std::string leftOutNote(const Diagram& diagram) {
  std::size_t left_out = 0;
  for (std::size_t site = 0; site < diagram.size(); ++site) left_out += hasPolygon(diagram, site) ? 0u : 1u;
  if (left_out == 0) return {};
  return fmt::format("--only-cells: {} of {} sites have no cell, and are left out", left_out, diagram.size());
}

/// Returns the path of the first GeoJSON file.
std::string geoJsonPath(const CellsTargets& targets) {
  const auto isGeoJson = [](std::string_view extension) { return extension.starts_with(".geojson"); };
  for (const CellsTarget& target : targets.cells) {
    if (isGeoJson(target.format->extension)) return target.path;
  }
  for (const EdgesTarget& target : targets.edges) {
    if (isGeoJson(target.format->extension)) return target.path;
  }
  return {};
}

}  // namespace

void printCellsNotes(const TalkOptions& talk, const CellsTargets& targets, const CellsOutput& output) {
  const auto note = [&talk](const std::string& text) {
    if (!talk.quiet && !text.empty()) printError("note: " + text);
  };
  if (targets.only_cells) note(leftOutNote(output.diagram));
  if (targets.carryAttributes()) note(renamingNote(output.attributes));
  const std::string geojson = geoJsonPath(targets);
  if (output.system.kind == CoordinateKind::plane && !geojson.empty()) {
    note(fmt::format(
        "{}: readers take the coordinates of GeoJSON for degrees, and these are of a plane; .gpkg "
        "says of which",
        geojson));
  }
}

}  // namespace vorpipe::cli
