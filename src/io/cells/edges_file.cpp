#include "io/cells/edges_file.h"

#include <array>
#include <cassert>
#include <cmath>
#include <new>
#include <span>

#include "io/base/error.h"
#include "io/base/format_list.h"

namespace vorpipe {

// One line for each kind of file: the name of what edges_NAME.cpp defines, NAME_edges.
// clang-format off
#define EDGES_FORMATS(format) \
  format(csv)                 \
  format(geojson)             \
  format(geojsonl)            \
  format(gpkg)                \
  format(wkt)                 \
  format(vtp)
// clang-format on

#define DECLARED(name) extern const EdgesFormat name##_edges;
EDGES_FORMATS(DECLARED)
#undef DECLARED

namespace {

#define LISTED(name) &name##_edges,
constexpr std::array edges_formats{EDGES_FORMATS(LISTED)};
#undef LISTED
constexpr std::span<const EdgesFormat* const> all_edges_formats(edges_formats);

/// Returns the index in Diagram::vertices of the end of a cell's edge.
std::uint64_t endEntry(const Cell& cell, std::uint64_t entry) {
  const CellRings rings = cell.rings();
  std::size_t r = 0;
  while (entry >= rings.end(r)) ++r;
  return entry + 1 < rings.end(r) ? entry + 1 : rings.begin(r);
}

}  // namespace

EdgeLine edgeLine(const EdgesOutput& output, std::size_t edge) {
  const Diagram& diagram = output.diagram;
  const std::uint64_t entry = output.topology.edge_entry[edge];
  const auto [site_a, site_b] = output.topology.edge_cells[edge];
  const Cell cell = diagram.cell(static_cast<std::size_t>(site_a));
  EdgeLine line{diagram.vertices[entry], diagram.vertices[endEntry(cell, entry)], site_a, site_b,
                diagram.edge_lengths[entry]};
  if (output.system.from_plane_around) {
    // Around a pole one edge leads from the last longitude to the first.
    constexpr double whole_turn = 360;
    line.end.x += whole_turn * std::round((line.begin.x - line.end.x) / whole_turn);
  }
  return line;
}

std::vector<std::string_view> edgesExtensions() { return extensionsOf(all_edges_formats); }

Result<const EdgesFormat*> edgesFormatOf(const std::string& path) {
  return formatFor(path, "edges", all_edges_formats);
}

Result<void> writeEdges(ByteSink& sink, const EdgesOutput& output, const EdgesFormat& format) {
  assert(output.topology.edge_of.size() == output.diagram.vertices.size());
  try {
    return format.write(sink, output);
  } catch (const std::bad_alloc&) {
    return deviceError(sink.name() + ": there is not enough memory to write the edges");
  }
}

}  // namespace vorpipe
