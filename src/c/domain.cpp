/// The domain of an input, and its plane.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/try.h"
#include "c/calls.h"
#include "c/handles.h"
#include "io/base/error.h"
#include "io/cells/cell_attributes.h"
#include "io/sites/density_place.h"
#include "io/sites/outline_file.h"
#include "io/sites/site_source.h"

namespace vorpipe::c {
namespace {

/// The words of messages, as in vorpipe_c.h.
DomainWords wordsFor(const vorpipe_input& input) {
  return {input.name,
          "domain",
          "vorpipe_input_set_box",
          "margin",
          "vorpipe_input_repair_outline",
          "project",
          "vorpipe_input_project",
          "vorpipe_input_project",
          "globe",
          "periodic",
          "density",
          "vorpipe_input_set_density_box"};
}

/// Adds only new notes: the domain may have been found before.
void addNotes(const vorpipe_input& input, std::vector<std::string> notes) {
  for (std::string& note : notes) {
    if (std::ranges::find(input.notes, note) == input.notes.end()) input.notes.push_back(std::move(note));
  }
}

/// Returns the sites in degrees, with the weights of the run.
std::shared_ptr<const Sites> givenInDegrees(PlacedSites& placed) {
  return std::make_shared<const Sites>(
      Sites{std::exchange(placed.longitudes, {}), std::exchange(placed.latitudes, {}), placed.sites.weight});
}

/// Finds the domain of an input. Errors: those of findDomain (input).
Result<PlacedInput> foundFor(const vorpipe_input& input) {
  PlacedInput placed{{}, input.sites, input.sites};
  PlacedSites& found = placed.domain;
  found.from = input.from;
  found.periodic = input.periodic;
  found.system = input.system;
  if (input.sites->size() > 0) {
    found.sites = *input.sites;
    VORPIPE_TRY(findDomain(input.domain, found, wordsFor(input)));
  }
  if (found.projection) placed.given = givenInDegrees(found);
  const bool moved = found.projection ||
                     (input.from == SitesFrom::generator && (found.globe || !input.domain.outline.empty()));
  if (moved) placed.sites = std::make_shared<const Sites>(std::exchange(found.sites, {}));
  if (moved && !found.projection) placed.given = placed.sites;
  found.sites = {};
  return placed;
}

/// Reuses the domain found before, with the present system and weights. Error (input): the system is that of
/// a plane, but the domain is projected.
Result<PlacedInput> keptFor(const vorpipe_input& input) {
  PlacedInput placed = *input.kept;
  const DomainWords words = wordsFor(input);
  CoordinateSystem& system = placed.domain.projection ? placed.domain.degrees : placed.domain.system;
  system = input.system;
  if (placed.domain.projection && system.kind == CoordinateKind::plane) {
    return inputError(fmt::format("{}: {} says that its coordinates are those of a plane, not degrees",
                                  words.project, words.sites));
  }
  if (placed.domain.projection) {
    system = degreesOf(system);
    system.from_plane_around = placed.domain.projection->center();
  }
  if (placed.domain.globe) {
    system = degreesOf(system);
    system.on_globe = true;
  }
  Sites sites = *placed.sites;
  sites.weight = input.sites->weight;
  placed.sites = std::make_shared<const Sites>(std::move(sites));
  placed.given = input.sites;
  return placed;
}

/// Returns the placed input, after checking the density with it. Errors: those of placeDensity (input).
Result<std::shared_ptr<const PlacedInput>> withDensity(const vorpipe_input& input) {
  if (input.density.values.empty() || input.density_looked_at == input.placed) return input.placed;
  PlacedSites placed = input.placed->domain;
  const DensityFile density{{input.density.width, input.density.height, {0}, input.density.box},
                            input.density_system};
  VORPIPE_TRY(placeDensity(density, input.density_name, placed, wordsFor(input)));
  addNotes(input, std::move(placed.notes));
  input.density_looked_at = input.placed;
  return input.placed;
}

/// Copies an offset table of `count` parts of `whole` things: it begins with 0, ascends, and ends with their
/// number.
Result<std::vector<std::uint64_t>> offsetsOf(const std::uint64_t* offsets, std::uint64_t count,
                                             std::uint64_t whole, std::string_view name) {
  if (offsets == nullptr) return inputError(fmt::format("{}: is NULL", name));
  std::vector<std::uint64_t> table(offsets, offsets + count + 1);
  if (table.front() != 0 || table.back() != whole || !std::ranges::is_sorted(table)) {
    return inputError(fmt::format("{}: does not ascend from 0 to {}", name, whole));
  }
  return table;
}

Result<Outline> outlineOf(const vorpipe_outline& given) {
  if (given.points == nullptr) return inputError("points: is NULL");
  VORPIPE_VAR(rings, offsetsOf(given.ring_offsets, given.ring_count, given.point_count, "ring_offsets"));
  VORPIPE_VAR(polygons,
              offsetsOf(given.polygon_offsets, given.polygon_count, given.ring_count, "polygon_offsets"));
  Outline outline;
  outline.ring_offsets = std::move(rings);
  outline.polygon_offsets = std::move(polygons);
  outline.points.reserve(given.point_count);
  for (std::uint64_t k = 0; k < given.point_count; ++k) {
    outline.points.push_back({given.points[2 * k], given.points[2 * k + 1]});
  }
  return outline;
}

/// Spreads a pattern over the box that is set, else over the unit square. Errors (input): the number of sites
/// changes, but there are weights.
Result<void> fillBox(vorpipe_input& input, const std::optional<Box>& box) {
  if (!input.generator) return {};
  Sites sites = sitesOf(*input.generator, box);
  const auto& weight = input.sites->weight;
  if (!weight.empty() && weight.size() != sites.size()) {
    return inputError(fmt::format("weights: {} for the {} sites of {} in this box; set the box first",
                                  weight.size(), sites.size(), input.name));
  }
  sites.weight = weight;
  input.sites = std::make_shared<const Sites>(std::move(sites));
  return {};
}

/// Replaces the clipping domain; the margin, the projection setting and the globe stay.
vorpipe_code setDomain(vorpipe_input& input, DomainSettings domain, Periodic periodic = Periodic::none) {
  if (input.domain.box || domain.box) {
    if (auto filled = fillBox(input, domain.box); !filled) return fail(filled.error());
  }
  domain.margin = input.domain.margin;
  domain.project = input.domain.project;
  domain.globe = input.domain.globe;
  domain.repair = input.domain.repair && !domain.outline.empty();
  input.domain = std::move(domain);
  input.periodic = periodic;
  findAnew(input);
  return VORPIPE_DONE;
}

vorpipe_code setOutline(vorpipe_input& input, Result<OutlineFile> given, std::string name) {
  if (!given) return fail(given.error());
  if (given->outline.empty()) return fail(VORPIPE_INPUT, "outline: has no points", Subject::outline);
  DomainSettings settings{std::move(given->outline), std::move(name)};
  settings.outline_system = std::move(given->system);
  return setDomain(input, std::move(settings));
}

}  // namespace

Result<std::shared_ptr<const PlacedInput>> placedInput(const vorpipe_input& input) {
  if (input.z != nullptr) return inputError("z: sites in space have cells alone, by vorpipe_cells");
  if (input.placed != nullptr) return withDensity(input);
  VORPIPE_VAR(placed, input.kept != nullptr ? keptFor(input) : foundFor(input));
  std::vector<std::string> notes = std::exchange(placed.domain.notes, {});
  if (std::string renamed = renamingNote(*input.attributes); !renamed.empty()) {
    notes.push_back(std::move(renamed));
  }
  addNotes(input, std::move(notes));
  input.placed = std::make_shared<const PlacedInput>(std::move(placed));
  return withDensity(input);
}

void findAnew(vorpipe_input& input) {
  input.kept = nullptr;
  input.placed = nullptr;
}

std::optional<PlanePositions> takeToDegrees(const PlacedInput& input, Diagram& diagram, int threads) {
  if (!input.domain.projection) return std::nullopt;
  PlanePositions plane{diagram.vertices, diagram.centroid, diagram.mass_centroid};
  toDegrees(*input.domain.projection, *input.given, diagram, threads);
  return plane;
}

Sites shownSites(const PlacedInput& input, Sites sites) {
  const auto& projection = input.domain.projection;
  return projection ? vorpipe::sitesInDegrees(*projection, *input.sites, *input.given, std::move(sites))
                    : sites;
}

std::unique_ptr<vorpipe_input> inputOf(const vorpipe_input& input, const PlacedInput& placed,
                                       const Sites& sites) {
  auto made = std::make_unique<vorpipe_input>(input);
  made->sites = std::make_shared<const Sites>(shownSites(placed, sites));
  PlacedInput other = placed;
  other.sites = std::make_shared<const Sites>(sites);
  other.given = made->sites;
  // The sites are no longer a pattern to spread over an outline or a box.
  made->from = SitesFrom::caller;
  made->generator.reset();
  made->kept = std::make_shared<const PlacedInput>(std::move(other));
  made->placed = made->kept;
  return made;
}

const CoordinateSystem& systemOf(const PlacedInput& input) {
  return input.domain.projection ? input.domain.degrees : input.domain.system;
}

}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

vorpipe_code vorpipe_input_set_box(vorpipe_input* input, double xmin, double ymin, double xmax, double ymax,
                                   vorpipe_axes periodic) {
  VORPIPE_NEEDS(input);
  if (periodic < VORPIPE_PERIODIC_NONE || periodic > VORPIPE_PERIODIC_XY) {
    return guarded(
        [&] { return fail(VORPIPE_INPUT, fmt::format("periodic: no axes {}", periodic), Subject::period); });
  }
  constexpr Periodic axes[] = {Periodic::none, Periodic::x, Periodic::y, Periodic::xy};
  return guarded([&] { return setDomain(*input, {{}, {}, Box{xmin, ymin, xmax, ymax}}, axes[periodic]); });
}

vorpipe_code vorpipe_input_set_outline(vorpipe_input* input, const vorpipe_outline* outline) {
  VORPIPE_NEEDS(input, outline);
  return guarded([&] {
    VORPIPE_TAKE(given, taken(outline, "vorpipe_outline"));
    return setOutline(*input, outlineOf(given).map([](Outline made) { return OutlineFile{std::move(made)}; }),
                      {});
  });
}

vorpipe_code vorpipe_input_read_outline(vorpipe_input* input, const char* path) {
  VORPIPE_NEEDS(input, path);
  return guarded([&] { return setOutline(*input, readOutline(path), path); });
}

vorpipe_code vorpipe_input_set_hull(vorpipe_input* input) {
  VORPIPE_NEEDS(input);
  return guarded([&] { return setDomain(*input, {{}, {}, {}, true}); });
}

vorpipe_code vorpipe_input_repair_outline(vorpipe_input* input) {
  VORPIPE_NEEDS(input);
  return guarded([&] {
    if (input->domain.outline.empty()) {
      return fail(VORPIPE_INPUT, "outline: there is none to repair", Subject::outline);
    }
    input->domain.repair = true;
    findAnew(*input);
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_set_margin(vorpipe_input* input, double margin, int32_t relative) {
  VORPIPE_NEEDS(input);
  return guarded([&] {
    if (!(margin >= 0) || !std::isfinite(margin)) {
      return fail(VORPIPE_INPUT, fmt::format("margin: {} is not a number of 0 or more", margin));
    }
    input->domain.margin = Margin{margin, relative != 0};
    findAnew(*input);
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_project(vorpipe_input* input, double longitude, double latitude) {
  VORPIPE_NEEDS(input);
  return guarded([&] {
    ProjectChoice choice;
    if (!std::isnan(longitude) || !std::isnan(latitude)) {
      choice.center = Point{longitude, latitude};
      if (auto projection = Projection::around(*choice.center); !projection) return fail(projection.error());
    }
    input->domain.project = choice;
    findAnew(*input);
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_set_globe(vorpipe_input* input) {
  VORPIPE_NEEDS(input);
  return guarded([&] {
    input->domain.globe = true;
    findAnew(*input);
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_domain(const vorpipe_input* input, double* box) {
  VORPIPE_NEEDS(input, box);
  return guarded([&] {
    VORPIPE_TAKE(placed, placedInput(*input));
    const auto [xmin, ymin, xmax, ymax] = placed->domain.domain;
    const double sides[] = {xmin, ymin, xmax, ymax};
    std::ranges::copy(sides, box);
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_set_system(vorpipe_input* input, vorpipe_system_kind kind, int64_t epsg) {
  VORPIPE_NEEDS(input);
  return guarded([&] {
    constexpr std::array kinds{CoordinateKind::unknown, CoordinateKind::degrees, CoordinateKind::plane};
    VORPIPE_TAKE(known, chosen(kinds, kind, "kind"));
    if (epsg < 0) return fail(VORPIPE_INPUT, fmt::format("epsg: is {}", epsg));
    CoordinateSystem system{known};
    if (epsg > 0) {
      system.organization = "EPSG";
      system.code = epsg;
    } else if (known == CoordinateKind::degrees) {
      system = wgs84();
    }
    input->system = std::move(system);
    input->placed = nullptr;
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_name_system(vorpipe_input* input, const char* name) {
  VORPIPE_NEEDS(input, name);
  return guarded([&] {
    auto system = systemNamed(name);
    if (!system) return fail(VORPIPE_INPUT, fmt::format("system: {}", system.error()), Subject::sites);
    input->system = std::move(*system);
    input->placed = nullptr;
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_name_outline_system(vorpipe_input* input, const char* name) {
  VORPIPE_NEEDS(input, name);
  return guarded([&] {
    if (input->domain.outline.empty()) {
      return fail(VORPIPE_INPUT, "outline: there is none that a system could be of", Subject::outline);
    }
    auto system = systemNamed(name);
    if (!system) return fail(VORPIPE_INPUT, fmt::format("system: {}", system.error()), Subject::outline);
    input->domain.outline_system = std::move(*system);
    findAnew(*input);
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_system(const vorpipe_input* input, vorpipe_system_kind* kind, int64_t* epsg) {
  VORPIPE_NEEDS(input, kind, epsg);
  *kind = static_cast<vorpipe_system_kind>(input->system.kind);
  *epsg = input->system.organization == "EPSG" ? input->system.code : 0;
  return VORPIPE_DONE;
}
