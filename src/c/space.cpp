/// Cells in space.
#include <fmt/core.h>

#include <array>
#include <utility>

#include "base/try.h"
#include "c/calls.h"
#include "c/handles.h"
#include "io/base/error.h"
#include "io/cells/space_file.h"

namespace vorpipe::c {
namespace {

/// Error (input): the input has something that is of the plane.
Result<void> refuseWhatIsOfPlane(const vorpipe_input& input) {
  const DomainSettings& domain = input.domain;
  const bool of_plane = !domain.outline.empty() || domain.box || domain.hull || domain.margin ||
                        domain.project || domain.globe || input.periodic != Periodic::none;
  if (of_plane) return inputError("domain: in space it is a box, of vorpipe_input_set_box3");
  if (!input.density.values.empty()) return inputError("density: is of a domain in the plane");
  if (input.surface != Surface::none) return inputError("surface: cells in space fill their domain");
  return {};
}

}  // namespace

Result<SpaceCells> cellsInSpace(vorpipe_session& session, const vorpipe_input& input,
                                const vorpipe_cells_options* given) {
  VORPIPE_TRY(refuseWhatIsOfPlane(input));
  VORPIPE_LET(options, taken(given, "vorpipe_cells_options"));
  constexpr std::array details{Detail3::polyhedra, Detail3::measures, Detail3::polyhedra};
  VORPIPE_LET(detail, chosen(details, options.detail, "detail"));
  if (options.search != VORPIPE_SEARCH_GRID)
    return inputError("search: cells in space are found on the grid alone");
  SpaceCells cells;
  const Sites& sites = *input.sites;
  cells.sites.reserve(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i)
    cells.sites.push_back({sites.x[i], sites.y[i], (*input.z)[i]});
  if (cells.sites.empty()) return inputError("sites: there are none");
  cells.options = {
      input.box3 ? *input.box3 : domainOf(cells.sites), detail, {}, {}, input.periodic3, input.lattice};
  cells.weights = sites.weight;
  Cells3Options whole = cells.whole();
  whole.progress = progressOf(options.progress, options.progress_user);
  VORPIPE_VAR(found, session.session.cells(cells.sites, whole));
  cells.diagram = std::move(found);
  return cells;
}

Result<void> refuseSpace(const vorpipe_diagram& diagram, std::string_view what) {
  if (!diagram.space) return {};
  return inputError(fmt::format("diagram: its cells are in space, and {} are of the plane", what));
}

Result<vorpipe_array> arrayInSpace(const SpaceCells& cells, vorpipe_diagram_field field) {
  const Diagram3& d = cells.diagram;
  switch (field) {
    case VORPIPE_CELL_STATUS:
      return array(d.status, VORPIPE_UINT8);
    case VORPIPE_CELL_OWNER:
      return array(d.owner, VORPIPE_UINT32);
    case VORPIPE_CELL_CENTROID:
      return array(d.centroid, VORPIPE_DOUBLE);
    case VORPIPE_CELL_SECOND_MOMENTS:
      return array(d.second_moments, VORPIPE_DOUBLE);
    case VORPIPE_CELL_OFFSETS:
      return array(d.face_offsets, VORPIPE_UINT64);
    case VORPIPE_CELL_NEIGHBORS:
      return array(d.neighbors, VORPIPE_INT64);
    case VORPIPE_CELL_VOLUME:
      return array(d.volume, VORPIPE_DOUBLE);
    case VORPIPE_CELL_SURFACE:
      return array(d.surface, VORPIPE_DOUBLE);
    case VORPIPE_FACE_AREA:
      return array(d.face_areas, VORPIPE_DOUBLE);
    case VORPIPE_FACE_SHIFTS:
      return array(d.neighbor_shifts, VORPIPE_INT32);
    case VORPIPE_FACE_OFFSETS:
      return array(d.face_vertex_offsets, VORPIPE_UINT64);
    case VORPIPE_FACE_VERTICES:
      return array(d.face_vertices, VORPIPE_UINT32);
    case VORPIPE_SPACE_VERTICES:
      return array(d.vertices, VORPIPE_DOUBLE);
    case VORPIPE_VERTEX_SITE_OFFSETS:
      return array(d.vertex_site_offsets, VORPIPE_UINT64);
    case VORPIPE_VERTEX_SITES:
      return array(d.vertex_sites, VORPIPE_INT64);
    default:
      return inputError(fmt::format("field: cells in space have no array {}", field));
  }
}

Result<void> writeInSpace(ByteSink& to, const vorpipe_diagram& diagram, const std::string& path) {
  VORPIPE_LET(format, spaceFormatOf(path));
  const SpaceCells& cells = *diagram.space;
  if (format->detail > cells.options.detail && format->extension != ".npz")
    return inputError(
        fmt::format("{}: {} needs cells of more detail than these have", to.name(), format->extension));
  return writeSpaceCells(
      to, {cells.sites, cells.diagram, *diagram.attributes, cells.options.detail, 0, cells.weights}, *format);
}

}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_input_set_box3(vorpipe_input* input, double xmin, double ymin, double zmin, double xmax,
                                    double ymax, double zmax) {
  VORPIPE_NEEDS(input);
  return guarded([&] {
    if (input->z == nullptr) return fail(VORPIPE_INPUT, "box3: the sites have no z");
    input->box3 = Box3{xmin, ymin, zmin, xmax, ymax, zmax};
    input->lattice.reset();
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_set_periodic3(vorpipe_input* input, int32_t x, int32_t y, int32_t z) {
  VORPIPE_NEEDS(input);
  return guarded([&] {
    if (!input->box3)
      return fail(VORPIPE_INPUT, "periodic3: no box has been set whose sides are the period",
                  Subject::period);
    input->periodic3 = {x != 0, y != 0, z != 0};
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_set_lattice(vorpipe_input* input, const double* vectors) {
  VORPIPE_NEEDS(input, vectors);
  return guarded([&] {
    if (input->z == nullptr) return fail(VORPIPE_INPUT, "lattice: the sites have no z");
    const double* const v = vectors;
    input->lattice = Lattice{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}};
    input->box3.reset();
    input->periodic3 = {};
    return vorpipe_code{VORPIPE_DONE};
  });
}

int32_t vorpipe_diagram_dimension(const vorpipe_diagram* diagram) {
  return diagram != nullptr && diagram->space ? 3 : 2;
}

double vorpipe_diagram_volume_sum(const vorpipe_diagram* diagram) {
  return diagram != nullptr && diagram->space ? volumeSum(diagram->space->diagram) : 0;
}
