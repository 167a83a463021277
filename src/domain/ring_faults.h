/// Finds where rounding has made the rings of a clipped cell cross or touch themselves.
#pragma once

#include "domain/clip_cell.h"

namespace vorpipe::core {

struct EdgePair {
  std::uint32_t e, f;
};

/// Adds each pair of edges that share more than ends. The test is exact for the vertices as they are. It
/// compares edges in `asked` with all others, and may add a pair twice. Two edges that run back and forth
/// between the same points do not count.
void findFaults(const ClippedCell& cell, std::span<const std::uint32_t> asked, std::vector<EdgePair>& faults);

}  // namespace vorpipe::core
