/// Which cells meet along which edges: what a backend finds out, before anything is measured.
#pragma once

#include "backend/backend.h"
#include "core/judge/judge.h"

namespace vorpipe::core {

/// The rows of all cells of a SiteSet, each certified or empty. With weights, those that were empty without
/// proof are open.

/// What finding a rows works with; all of it outlives the call.
struct SearchInput {
  Backend& backend;
  Judge& judge;  ///< of the same sites; finds in double what the backend does not certify
  const SiteSet& sites;
  const SearchOptions& search;
  int threads;
  const Progress& progress;
};

/// Gives the sites to the backend and finds every cell there, fast, then with more room; the judge finds
/// the rest. In `report`: retried, in_double, exact, and the times of upload and search.
/// Errors: those of the backends; progress said stop.
Result<NeighborRows> findNeighbors(const SearchInput& input, Report& report);

/// Has the judge find the cells of `which` (ascending) again, beginning with `precision`, and
/// replaces them.
Result<void> findAgain(const SearchInput& input, const std::vector<std::uint32_t>& which, Precision precision,
                       NeighborRows& rows);

/// Replaces all cells by those of the judge's mesh; false, and nothing is changed, where there is none.
bool findAllInMesh(const SearchInput& input, NeighborRows& rows);

}  // namespace vorpipe::core
