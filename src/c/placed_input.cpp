#include "c/placed_input.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
#include "io/cells/cell_attributes.h"
#include "io/sites/density_place.h"

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
  const bool moved =
      found.projection || (input.from == SitesFrom::generator && !input.domain.outline.empty());
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

}  // namespace

Result<std::shared_ptr<const PlacedInput>> placedInput(const vorpipe_input& input) {
  if (input.placed != nullptr) return withDensity(input);
  auto placed = input.kept != nullptr ? keptFor(input) : foundFor(input);
  if (!placed) return tl::unexpected(std::move(placed.error()));
  std::vector<std::string> notes = std::exchange(placed->domain.notes, {});
  if (std::string renamed = renamingNote(*input.attributes); !renamed.empty()) {
    notes.push_back(std::move(renamed));
  }
  addNotes(input, std::move(notes));
  input.placed = std::make_shared<const PlacedInput>(std::move(*placed));
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
