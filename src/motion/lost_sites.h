/// Sites that own nothing, and so cannot move by themselves.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "motion/allowed_places.h"
#include "vorpipe.h"

namespace vorpipe::moving {

/// How many sites were given places, and why.
struct LostSites {
  std::uint64_t duplicates = 0, outside = 0, massless = 0;
  std::uint64_t hidden = 0;  ///< stay: others of larger weight hide them

  [[nodiscard]] bool moved() const { return duplicates + outside + massless > 0; }
  /// A line for each kind.
  [[nodiscard]] std::vector<std::string> notes() const;
};

/// Gives each of them a place, in `places`, where all other sites already stand where they move to: one that
/// stands where another one does, beside it; one outside of the domain, the nearest place in it; one whose
/// cell has no mass, beside the site of a cell with much energy. None of that can add energy: what such a
/// site leaves has no part in it, and another site to choose from makes no distance longer.
LostSites placeLostSites(const Sites& sites, const CellMoments& moments, const AllowedPlaces& allowed,
                         Sites& places);

}  // namespace vorpipe::moving
