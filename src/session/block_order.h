/// A spatially coherent order of places.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// Returns the indices of places, grouped by the blocks of a grid over a box. A place beyond the box belongs
/// to the nearest block at the border.
std::vector<std::uint32_t> orderByBlocks(std::span<const Point> places, const Box& box);

}  // namespace vorpipe::core
