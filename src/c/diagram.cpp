
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "c/calls.h"
#include "c/handles.h"
#include "vorpipe/free_surface.h"

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
    case VORPIPE_CELL_SOLID_ANGLE:
      return array(diagram.solid_angle, VORPIPE_DOUBLE);
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
  if (input.z != nullptr) {
    VORPIPE_TAKE(cells, cellsInSpace(session, input, given));
    *diagram = new vorpipe_diagram{nullptr, input.attributes, {}, {}, {}, false, {}, {}, {}, {}};
    (*diagram)->space = std::move(cells);
    return VORPIPE_DONE;
  }
  VORPIPE_TAKE(placed, placedInput(input));
  VORPIPE_TAKE(options, cellsOptions(input, *placed, given));
  VORPIPE_TAKE(found, cellsWith(input.surface, session.session, *placed->sites, options));
  options.progress = nullptr;
  auto plane = takeToDegrees(*placed, found, session.threads);
  *diagram = new vorpipe_diagram{placed,
                                 input.attributes,
                                 std::move(options),
                                 std::move(found),
                                 std::move(plane),
                                 input.surface == Surface::free,
                                 {},
                                 {},
                                 {},
                                 {}};
  return VORPIPE_DONE;
}

/// Returns cells in degrees as the plane had them: their rings and neighbors.
Diagram inPlane(const vorpipe_diagram& diagram) {
  const Diagram& shown = diagram.diagram;
  Diagram plane;
  plane.status = shown.status;
  plane.cell_offsets = shown.cell_offsets;
  plane.ring_starts = shown.ring_starts;
  plane.neighbors = shown.neighbors;
  plane.vertices = diagram.plane->vertices;
  return plane;
}

/// Returns the topology of cells in degrees. Shared positions are determined in the plane.
Result<Topology> topologyByPlane(const vorpipe_diagram& diagram) {
  auto topology = topologyOf(inPlane(diagram));
  if (topology) toDegrees(*diagram.input->domain.projection, *topology);
  return topology;
}

/// Angles are those of the plane.
Borders bordersOf(const vorpipe_diagram& diagram) {
  Borders borders;
  if (!diagram.has_air) return borders;
  const Sites& sites = *diagram.input->sites;
  const auto& projection = diagram.input->domain.projection;
  Diagram cells = diagram.diagram;
  if (diagram.plane) cells.vertices = diagram.plane->vertices;
  borders.offsets.push_back(0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const BorderPart& part : borderOf(Cell(cells, i), {sites.x[i], sites.y[i]})) {
      const Point from = projection ? projection->toDegrees(part.from) : part.from;
      const Point to = projection ? projection->toDegrees(part.to) : part.to;
      borders.parts.push_back({from.x, from.y, to.x, to.y, part.angle});
      borders.neighbors.push_back(part.neighbor);
    }
    borders.offsets.push_back(borders.parts.size());
  }
  return borders;
}

/// Returns the array of a field from VORPIPE_BORDER_OFFSETS on; it is found once, and the diagram keeps it.
/// Empty if cells fill the domain. Error (input): there is no such field.
Result<vorpipe_array> borderArrayOf(const vorpipe_diagram& diagram, vorpipe_diagram_field field) {
  std::call_once(diagram.borders_once, [&] { diagram.borders = bordersOf(diagram); });
  switch (field) {
    case VORPIPE_BORDER_OFFSETS:
      return array(diagram.borders.offsets, VORPIPE_UINT64);
    case VORPIPE_BORDER_PARTS:
      return array(diagram.borders.parts, VORPIPE_DOUBLE);
    case VORPIPE_BORDER_NEIGHBORS:
      return array(diagram.borders.neighbors, VORPIPE_INT64);
    default:
      return noField(field);
  }
}

/// Returns the array of a field from VORPIPE_MESH_VERTICES on; it is found once, and the diagram keeps it.
/// Errors: those of cellTriangles; there is no such field (input).
Result<vorpipe_array> meshArrayOf(const vorpipe_diagram& diagram, vorpipe_diagram_field field) {
  std::call_once(diagram.mesh_once, [&] {
    diagram.mesh = diagram.plane ? cellTriangles(inPlane(diagram)) : cellTriangles(diagram.diagram);
    for (const Point& vertex : diagram.diagram.vertices) {
      diagram.mesh_vertices.push_back({static_cast<float>(vertex.x), static_cast<float>(vertex.y)});
    }
  });
  const auto& mesh = *diagram.mesh;
  if (!mesh) return tl::unexpected(mesh.error());
  switch (field) {
    case VORPIPE_MESH_VERTICES:
      return array(diagram.mesh_vertices, VORPIPE_FLOAT);
    case VORPIPE_MESH_SITES:
      return array(mesh->sites, VORPIPE_UINT32);
    case VORPIPE_MESH_TRIANGLES:
      return array(mesh->triangles, VORPIPE_UINT32);
    default:
      return noField(field);
  }
}

/// Removes found sites whose discs do not reach the places that they were found for.
void leaveOutAir(const Sites& sites, const Point* places, std::uint64_t count, std::uint32_t* found) {
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::uint32_t i = found[k];
    if (i == no_site) continue;
    const double dx = places[k].x - sites.x[i], dy = places[k].y - sites.y[i];
    if (sites.weight.empty() || dx * dx + dy * dy > sites.weight[i]) found[k] = no_site;
  }
}

}  // namespace

const Result<Topology>& sharedPartsOf(const vorpipe_diagram& diagram) {
  std::call_once(diagram.topology_once, [&] {
    diagram.topology = diagram.plane ? topologyByPlane(diagram) : topologyOf(diagram.diagram);
  });
  return *diagram.topology;
}

Result<Diagram> cellsWith(Surface surface, Session& session, const Sites& sites, CellsOptions& options) {
  if (surface == Surface::none) return session.cells(sites, options);
  options.detail = Detail::polygons;
  return freeCells(session, sites, options);
}

}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_cells(vorpipe_session* session, const vorpipe_input* input,
                           const vorpipe_cells_options* options, vorpipe_diagram** diagram) {
  VORPIPE_NEEDS(session, input, diagram);
  return guardedRun(*session, [&] { return find(*session, *input, options, diagram); });
}

void vorpipe_diagram_free(vorpipe_diagram* diagram) { delete diagram; }

vorpipe_code vorpipe_diagram_array(const vorpipe_diagram* diagram, vorpipe_diagram_field field,
                                   vorpipe_array* array) {
  VORPIPE_NEEDS(diagram, array);
  return guarded([&] {
    if (diagram->space) return give(arrayInSpace(*diagram->space, field), array);
    if (field > VORPIPE_CELL_SOLID_ANGLE) return give(arrayOf(diagram->diagram, field), array);
    if (field == VORPIPE_CELL_SOLID_ANGLE) return give(arrayOf(diagram->diagram, field), array);
    if (field > VORPIPE_BORDER_NEIGHBORS) return give(meshArrayOf(*diagram, field), array);
    if (field > VORPIPE_EDGE_CELLS) return give(borderArrayOf(*diagram, field), array);
    const bool shared = field >= VORPIPE_SHARED_VERTICES;
    return give(shared ? sharedArrayOf(*diagram, field) : arrayOf(diagram->diagram, field), array);
  });
}

double vorpipe_diagram_area_sum(const vorpipe_diagram* diagram) {
  return diagram == nullptr ? 0 : areaSum(diagram->diagram);
}

vorpipe_code vorpipe_diagram_report(const vorpipe_diagram* diagram, vorpipe_report* report) {
  VORPIPE_NEEDS(diagram, report);
  return guarded([&] { return codeOf(give(reportOf(diagram->report()), report, "vorpipe_report")); });
}

const char* vorpipe_diagram_note(const vorpipe_diagram* diagram, size_t index) {
  return diagram == nullptr ? nullptr : textAt(diagram->report().notes, index);
}

const char* vorpipe_diagram_validation(const vorpipe_diagram* diagram, size_t index) {
  return diagram == nullptr ? nullptr : textAt(diagram->report().validation_messages, index);
}

vorpipe_code vorpipe_input_set_surface(vorpipe_input* input, vorpipe_surface surface) {
  VORPIPE_NEEDS(input);
  return guarded([&] {
    constexpr std::array surfaces{Surface::none, Surface::free};
    VORPIPE_TAKE(known, chosen(surfaces, surface, "surface"));
    input->surface = known;
    return vorpipe_code{VORPIPE_DONE};
  });
}

static_assert(sizeof(Point) == 2 * sizeof(double));

vorpipe_code vorpipe_locator_create(const vorpipe_input* input, int32_t threads, vorpipe_locator** locator) {
  VORPIPE_NEEDS(input, locator);
  return guarded([&] {
    VORPIPE_TAKE(count, threadsOf(threads));
    VORPIPE_TAKE(placed, placedInput(*input));
    VORPIPE_TAKE(options, cellsOptions(*input, *placed, nullptr));
    VORPIPE_TAKE(made, Locator::make(*placed->sites, options, count));
    const bool has_air = input->surface == Surface::free;
    *locator =
        new vorpipe_locator{std::move(made), has_air ? placed->sites : nullptr, placed->domain.projection};
    return vorpipe_code{VORPIPE_DONE};
  });
}

void vorpipe_locator_free(vorpipe_locator* locator) { delete locator; }

vorpipe_code vorpipe_locator_find(const vorpipe_locator* locator, const double* places, uint64_t count,
                                  uint32_t* sites) {
  VORPIPE_NEEDS(locator);
  if (places == nullptr && count > 0) return missing("places");
  if (sites == nullptr && count > 0) return missing("sites");
  return guarded([&] {
    std::span given(reinterpret_cast<const Point*>(places), count);
    std::vector<Point> plane;
    if (locator->projection) {
      plane.resize(count);
      std::ranges::transform(given, plane.begin(),
                             [&](Point place) { return locator->projection->toPlane(place); });
      given = plane;
    }
    locator->locator.at(given, {sites, count});
    if (locator->discs != nullptr) leaveOutAir(*locator->discs, given.data(), count, sites);
    return vorpipe_code{VORPIPE_DONE};
  });
}
