/// Finds, with a backend, which cells meet along which edges, before anything is measured.
#pragma once

#include <optional>

#include "cells/device_ladder.h"

namespace vorpipe::core {

/// Gives the sites to the backend and finds every cell of the set, each certified or empty. With weights,
/// cells that were empty without proof become `open`. In `report`: retried, in_double, exact, and the times
/// of upload and search. Errors: those of the backend; progress requested a stop.
Result<NeighborRows> findNeighbors(const SearchInput& input, Report& report);

/// The same, but returns nothing as soon as weights are proved to leave a site no cell.
Result<std::optional<NeighborRows>> findNeighborsUnlessEmpty(const SearchInput& input, Report& report);

/// Has the judge find the cells of `which` (ascending) again, beginning with `precision`, and
/// replaces them.
Result<void> findAgain(const SearchInput& input, const std::vector<std::uint32_t>& which, Precision precision,
                       NeighborRows& rows);

/// Replaces all cells by those of the judge's mesh. Returns false and changes nothing if there is none.
bool findAllInMesh(const SearchInput& input, NeighborRows& rows);

}  // namespace vorpipe::core
