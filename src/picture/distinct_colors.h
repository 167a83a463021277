/// Few colors, so that cells with a common edge differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// Returns a color for each site, counted from 0: that of no neighbor. In a plane it takes at most six, on a
/// torus seven, mostly four or five. Error (input): it takes more than `most`.
Result<std::vector<std::uint8_t>> distinctColors(const Diagram& cells, std::size_t most);

}  // namespace vorpipe::core
