#include "c/surface.h"

#include <array>

#include "c/array.h"
#include "c/failure.h"
#include "c/options.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::c {
namespace {

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

}  // namespace

Result<Diagram> cellsWith(Surface surface, Session& session, const Sites& sites, CellsOptions& options) {
  if (surface == Surface::none) return session.cells(sites, options);
  options.detail = Detail::polygons;
  return freeCells(session, sites, options);
}

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

void leaveOutAir(const Sites& sites, const Point* places, std::uint64_t count, std::uint32_t* found) {
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::uint32_t i = found[k];
    if (i == no_site) continue;
    const double dx = places[k].x - sites.x[i], dy = places[k].y - sites.y[i];
    if (sites.weight.empty() || dx * dx + dy * dy > sites.weight[i]) found[k] = no_site;
  }
}

}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_input_set_surface(vorpipe_input* input, vorpipe_surface surface) {
  if (input == nullptr) return missing("input");
  return guarded([&] {
    constexpr std::array surfaces{Surface::none, Surface::free};
    const auto known = chosen(surfaces, surface, "surface");
    if (!known) return fail(known.error());
    input->surface = *known;
    return vorpipe_code{VORPIPE_DONE};
  });
}
