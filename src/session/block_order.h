/// An order in which places near each other follow each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// The indices of places, block by block of a grid over a box; any place has a block, one beyond the box that
/// at its border.
std::vector<std::uint32_t> orderByBlocks(std::span<const Point> places, const Box& box);

}  // namespace vorpipe::core
