#include "c/placed_input.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/cells/cell_attributes.h"

namespace vorpipe::c {
namespace {

/// What messages name, as vorpipe_c.h does.
DomainWords wordsFor(const vorpipe_input& input) {
  return {input.name,
          "domain",
          "vorpipe_input_set_box",
          "margin",
          "vorpipe_input_repair_outline",
          "project",
          "vorpipe_input_project",
          "vorpipe_input_project",
          "periodic"};
}

/// Notes that are new: the domain may have been found before.
void addNotes(const vorpipe_input& input, std::vector<std::string> notes) {
  for (std::string& note : notes) {
    if (std::ranges::find(input.notes, note) == input.notes.end()) input.notes.push_back(std::move(note));
  }
}

/// Sites in degrees, with the weights of the run.
std::shared_ptr<const Sites> sitesInDegrees(PlacedSites& placed) {
  return std::make_shared<const Sites>(
      Sites{std::exchange(placed.longitudes, {}), std::exchange(placed.latitudes, {}), placed.sites.weight});
}

}  // namespace

Result<std::shared_ptr<const PlacedInput>> placedInput(const vorpipe_input& input) {
  if (input.placed != nullptr) return input.placed;
  PlacedInput placed{{}, input.sites, input.sites};
  PlacedSites& found = placed.domain;
  found.from = input.from;
  found.periodic = input.periodic;
  found.system = input.system;
  if (input.sites->size() > 0) {
    found.sites = *input.sites;
    if (auto done = findDomain(input.domain, found, wordsFor(input)); !done) {
      return tl::unexpected(std::move(done.error()));
    }
  }
  if (found.projection) placed.given = sitesInDegrees(found);
  const bool moved =
      found.projection || (input.from == SitesFrom::generator && !input.domain.outline.empty());
  if (moved) placed.sites = std::make_shared<const Sites>(std::exchange(found.sites, {}));
  if (moved && !found.projection) placed.given = placed.sites;
  found.sites = {};
  std::vector<std::string> notes = std::exchange(found.notes, {});
  if (std::string renamed = renamingNote(*input.attributes); !renamed.empty()) {
    notes.push_back(std::move(renamed));
  }
  addNotes(input, std::move(notes));
  input.placed = std::make_shared<const PlacedInput>(std::move(placed));
  return input.placed;
}

std::optional<PlanePositions> takeToDegrees(const PlacedInput& input, Diagram& diagram, int threads) {
  if (!input.domain.projection) return std::nullopt;
  PlanePositions plane{diagram.vertices, diagram.centroid, diagram.mass_centroid};
  toDegrees(*input.domain.projection, *input.given, diagram, threads);
  return plane;
}

Sites shownSites(const PlacedInput& input, Sites sites) {
  const auto& projection = input.domain.projection;
  for (std::size_t i = 0; projection && i < sites.size(); ++i) {
    const Point degrees = projection->toDegrees({sites.x[i], sites.y[i]});
    sites.x[i] = degrees.x;
    sites.y[i] = degrees.y;
  }
  return sites;
}

std::unique_ptr<vorpipe_input> inputOf(const vorpipe_input& input, const PlacedInput& placed,
                                       const Sites& sites) {
  auto made = std::make_unique<vorpipe_input>(input);
  made->sites = std::make_shared<const Sites>(shownSites(placed, sites));
  PlacedInput other = placed;
  other.sites = std::make_shared<const Sites>(sites);
  other.given = made->sites;
  made->placed = std::make_shared<const PlacedInput>(std::move(other));
  return made;
}

const CoordinateSystem& systemOf(const PlacedInput& input) {
  return input.domain.projection ? input.domain.degrees : input.domain.system;
}

}  // namespace vorpipe::c
