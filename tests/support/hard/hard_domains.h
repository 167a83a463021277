/// Domains that are hard on arithmetic.
#pragma once

#include <span>
#include <string_view>

#include "support/hard/hard_random.h"

namespace vorpipe::test {

struct HardDomain {
  std::string_view name;
  /// For sites that have the box `around`, which is no point. May be no valid box, where doubles are too
  /// coarse.
  Box (*make)(const Sites& sites, const Box& around, Random& random);
};

std::span<const HardDomain> hardDomains();

/// The box of the sites, and a twentieth of its longer side more on each side of it; half of one if all sites
/// stand in one place.
Box boxOfFile(const Sites& sites);

/// Polygons in or about `box`, some with holes or several rings, with points at sites and vertices, on lines
/// with them, and on each other's lines; half of them rectilinear, with sides in bisectors of sites.
Outline hardOutline(const Sites& sites, const Box& box, Random& random);

}  // namespace vorpipe::test
