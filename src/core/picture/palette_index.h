/// Which of a palette's 256 colors each site gets.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

/// Returns a palette index for each of `ids`, indices in the input. By site: 256 i / (n + 1), as in the
/// thesis (Listing A.2), i the input index of n. By area, neighbors or weight: linear from the least to the
/// greatest. `cells` are the measures of the same sites; by site and by weight they are not read. Error
/// (input): color by weight of sites without weights.
Result<std::vector<std::uint8_t>> paletteIndices(ColorBy color, const Sites& sites,
                                                 std::span<const std::uint32_t> ids, const Diagram& cells);

}  // namespace vorpipe::core
