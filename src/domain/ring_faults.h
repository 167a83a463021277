/// Where rounding has made the rings of a clipped cell cross or touch themselves.
#pragma once

#include "domain/clip_cell.h"

namespace vorpipe::core {

struct EdgePair {
  std::uint32_t e, f;
};

/// Adds each pair of edges that have more in common than ends, exactly, of the vertices as they are: of those
/// in `asked` with all others, once or twice. Two that run to and fro between the same points are none.
void findFaults(const ClippedCell& cell, std::span<const std::uint32_t> asked, std::vector<EdgePair>& faults);

}  // namespace vorpipe::core
