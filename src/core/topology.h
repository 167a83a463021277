/// Which cells meet along which edges: what a backend finds out, before anything is measured.
#pragma once

#include "backend/backend.h"
#include "core/flann_search.h"

namespace vorpipe {

/// The neighbors of each cell of a SiteSet, counter-clockwise: cell i has those at first[i] ..
/// first[i + 1] - 1. A neighbor is an index in the set or a wall.
struct Topology {
  std::vector<CellStatus> status;  ///< certified or empty
  std::vector<std::uint64_t> first{0};
  std::vector<std::int64_t> neighbor;
};

/// What finding a topology works with; all of it outlives the call.
struct TopologyInput {
  Backend& backend;
  Backend& judge;  ///< clips in double what the backend does not certify
  const SiteSet& sites;
  const FlannSearch& search;
  std::size_t neighbors;
  int threads;
  const Progress& progress;
};

/// Clips every cell by its nearest neighbors on the backend; what that does not certify is found on
/// the host. in_double is increased by the number of those.
Result<Topology> findTopology(const TopologyInput& input, std::uint64_t& in_double);

/// Finds the cells of `which` (ascending) anew, in double on the host, and replaces them.
Result<void> findAgain(const TopologyInput& input, const std::vector<std::uint32_t>& which,
                       Topology& topology);

}  // namespace vorpipe
