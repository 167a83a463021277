/// Patterns of sites in boxes of any shape.
#pragma once

#include <cstdint>

#include "vorpipe/sites.h"

namespace vorpipe {

/// About n sites of a pattern all over a box whose sides are finite and more than 0. Spacings are alike along
/// both axes, as far as a box holds whole numbers of them; clusters and the circle, around the middle, whose
/// radius is 0.4 of the shorter side, keep their shape. In the unit square they are those of
/// generate(pattern, n, seed), and with another box `square` and `hex` may be another number.
Sites generate(Pattern pattern, std::uint64_t n, std::uint64_t seed, const Box& box);

}  // namespace vorpipe
