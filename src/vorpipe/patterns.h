/// Patterns of sites in boxes of any shape.
#pragma once

#include <cstdint>

#include "vorpipe/sites.h"

namespace vorpipe {

/// About n sites of a pattern over a whole box, whose sides are finite and positive. Spacings are nearly
/// equal along both axes, as far as a box holds whole numbers of them. Clusters, and the circle around the
/// middle with radius 0.4 of the shorter side, keep their shape. In the unit square the sites are those of
/// generate(pattern, n, seed); in other boxes `square` and `hex` may have a different number.
Sites generate(Pattern pattern, std::uint64_t n, std::uint64_t seed, const Box& box);

}  // namespace vorpipe
