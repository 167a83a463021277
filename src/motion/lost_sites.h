/// Sites whose cells are empty or massless, so that they cannot move by themselves.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "motion/allowed_places.h"
#include "vorpipe.h"

namespace vorpipe::moving {

/// Number of sites that were given new places, by reason.
struct LostSites {
  std::uint64_t duplicates = 0, outside = 0, massless = 0;
  std::uint64_t hidden = 0;  ///< these stay: sites of larger weight hide them

  [[nodiscard]] bool moved() const { return duplicates + outside + massless > 0; }
  /// Returns a line for each kind.
  [[nodiscard]] std::vector<std::string> notes() const;
};

/// Gives each lost site a place in `places`, which already holds the targets of all other sites. A duplicate
/// goes beside the site at its place. A site outside of the domain goes to the nearest place in it. A site
/// whose cell has no mass goes beside the site of a cell with much energy. None of this can add energy: a
/// lost site contributes none where it was, and another site to choose from makes no distance longer.
LostSites placeLostSites(const Sites& sites, const CellMoments& moments, const AllowedPlaces& allowed,
                         Sites& places);

}  // namespace vorpipe::moving
