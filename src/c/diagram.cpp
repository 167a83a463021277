/// Cells: runs, arrays, sums, reports.
#include <fmt/core.h>

#include <span>
#include <utility>

#include "c/array.h"
#include "c/failure.h"
#include "c/handles.h"
#include "c/options.h"
#include "c/placed_input.h"
#include "c/session_use.h"
#include "c/shared_parts.h"
#include "c/structs.h"
#include "c/surface.h"

namespace vorpipe::c {
namespace {

Result<vorpipe_array> arrayOf(const Topology& topology, vorpipe_diagram_field field) {
  switch (field) {
    case VORPIPE_SHARED_VERTICES:
      return array(topology.vertices, VORPIPE_DOUBLE);
    case VORPIPE_VERTEX_OF:
      return array(topology.vertex_of, VORPIPE_UINT32);
    case VORPIPE_EDGE_OF:
      return array(topology.edge_of, VORPIPE_UINT32);
    case VORPIPE_EDGE_ENTRY:
      return array(topology.edge_entry, VORPIPE_UINT64);
    case VORPIPE_EDGE_VERTICES:
      return array(topology.edge_vertices, VORPIPE_UINT32);
    case VORPIPE_EDGE_CELLS:
      return array(topology.edge_cells, VORPIPE_INT64);
    default:
      return noField(field);
  }
}

Result<vorpipe_array> arrayOf(const Diagram& diagram, vorpipe_diagram_field field) {
  switch (field) {
    case VORPIPE_CELL_STATUS:
      return array(diagram.status, VORPIPE_UINT8);
    case VORPIPE_CELL_OWNER:
      return array(diagram.owner, VORPIPE_UINT32);
    case VORPIPE_CELL_AREA:
      return array(diagram.area, VORPIPE_DOUBLE);
    case VORPIPE_CELL_PERIMETER:
      return array(diagram.perimeter, VORPIPE_DOUBLE);
    case VORPIPE_CELL_CENTROID:
      return array(diagram.centroid, VORPIPE_DOUBLE);
    case VORPIPE_CELL_SECOND_MOMENTS:
      return array(diagram.second_moments, VORPIPE_DOUBLE);
    case VORPIPE_CELL_OFFSETS:
      return array(diagram.cell_offsets, VORPIPE_UINT64);
    case VORPIPE_CELL_VERTICES:
      return array(diagram.vertices, VORPIPE_DOUBLE);
    case VORPIPE_CELL_NEIGHBORS:
      return array(diagram.neighbors, VORPIPE_INT64);
    case VORPIPE_CELL_EDGE_LENGTHS:
      return array(diagram.edge_lengths, VORPIPE_DOUBLE);
    case VORPIPE_CELL_NEIGHBOR_SHIFTS:
      return array(diagram.neighbor_shifts, VORPIPE_INT32);
    case VORPIPE_CELL_RING_STARTS:
      return array(diagram.ring_starts, VORPIPE_UINT64);
    case VORPIPE_CELL_MASS:
      return array(diagram.mass, VORPIPE_DOUBLE);
    case VORPIPE_CELL_MASS_CENTROID:
      return array(diagram.mass_centroid, VORPIPE_DOUBLE);
    case VORPIPE_TRIANGLES:
      return array(diagram.triangles, VORPIPE_UINT32);
    default:
      return noField(field);
  }
}

Result<vorpipe_array> sharedArrayOf(const vorpipe_diagram& diagram, vorpipe_diagram_field field) {
  const auto& topology = sharedPartsOf(diagram);
  if (!topology) return tl::unexpected(topology.error());
  return arrayOf(*topology, field);
}

vorpipe_code find(vorpipe_session& session, const vorpipe_input& input, const vorpipe_cells_options* given,
                  vorpipe_diagram** diagram) {
  const auto placed = placedInput(input);
  if (!placed) return fail(placed.error());
  auto options = cellsOptions(input, **placed, given);
  if (!options) return fail(options.error());
  auto found = cellsWith(input.surface, session.session, *(*placed)->sites, *options);
  if (!found) return fail(found.error());
  options->progress = nullptr;
  auto plane = takeToDegrees(**placed, *found, session.threads);
  *diagram = new vorpipe_diagram{*placed,
                                 input.attributes,
                                 std::move(*options),
                                 std::move(*found),
                                 std::move(plane),
                                 input.surface == Surface::free,
                                 {},
                                 {},
                                 {},
                                 {}};
  return VORPIPE_DONE;
}

/// Returns the topology of cells in degrees. Shared positions are determined in the plane.
Result<Topology> topologyByPlane(const vorpipe_diagram& diagram) {
  const Diagram& shown = diagram.diagram;
  Diagram plane;
  plane.status = shown.status;
  plane.cell_offsets = shown.cell_offsets;
  plane.ring_starts = shown.ring_starts;
  plane.neighbors = shown.neighbors;
  plane.vertices = diagram.plane->vertices;
  auto topology = topologyOf(plane);
  if (topology) toDegrees(*diagram.input->domain.projection, *topology);
  return topology;
}

}  // namespace

const Result<Topology>& sharedPartsOf(const vorpipe_diagram& diagram) {
  std::call_once(diagram.topology_once, [&] {
    diagram.topology = diagram.plane ? topologyByPlane(diagram) : topologyOf(diagram.diagram);
  });
  return *diagram.topology;
}

}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_cells(vorpipe_session* session, const vorpipe_input* input,
                           const vorpipe_cells_options* options, vorpipe_diagram** diagram) {
  if (session == nullptr) return missing("session");
  if (input == nullptr) return missing("input");
  if (diagram == nullptr) return missing("diagram");
  return guardedRun(*session, [&] { return find(*session, *input, options, diagram); });
}

void vorpipe_diagram_free(vorpipe_diagram* diagram) { delete diagram; }

vorpipe_code vorpipe_diagram_array(const vorpipe_diagram* diagram, vorpipe_diagram_field field,
                                   vorpipe_array* array) {
  if (diagram == nullptr) return missing("diagram");
  if (array == nullptr) return missing("array");
  return guarded([&] {
    if (field > VORPIPE_EDGE_CELLS) return give(borderArrayOf(*diagram, field), array);
    const bool shared = field >= VORPIPE_SHARED_VERTICES;
    return give(shared ? sharedArrayOf(*diagram, field) : arrayOf(diagram->diagram, field), array);
  });
}

double vorpipe_diagram_area_sum(const vorpipe_diagram* diagram) {
  return diagram == nullptr ? 0 : areaSum(diagram->diagram);
}

vorpipe_code vorpipe_diagram_report(const vorpipe_diagram* diagram, vorpipe_report* report) {
  if (diagram == nullptr) return missing("diagram");
  if (report == nullptr) return missing("report");
  return guarded([&] { return codeOf(give(reportOf(diagram->diagram.report), report, "vorpipe_report")); });
}

const char* vorpipe_diagram_note(const vorpipe_diagram* diagram, size_t index) {
  return diagram == nullptr ? nullptr : textAt(diagram->diagram.report.notes, index);
}

const char* vorpipe_diagram_validation(const vorpipe_diagram* diagram, size_t index) {
  return diagram == nullptr ? nullptr : textAt(diagram->diagram.report.validation_messages, index);
}
