/// Finds, with a backend, which cells meet along which edges, before anything is measured.
#pragma once

#include <optional>

#include "cells/device_ladder.h"

namespace vorpipe::core {

/// Whether to end, with nothing, as soon as a site is proved to have no cell.
enum class AtEmpty : std::uint8_t { ignore, end };

/// Gives the sites to the backend and finds every cell of the set, each certified or empty. With weights,
/// cells that were empty without proof become `open`. In `report`: retried, in_double, exact, and the times
/// of upload and search. Returns nothing only for AtEmpty::end. Errors: those of the backend; progress
/// requested a stop.
Result<std::optional<NeighborRows>> findNeighbors(const SearchInput& input, AtEmpty at_empty, Report& report);

/// Has the exact search find the cells of `which` (ascending) again, beginning with `precision`, and
/// replaces them.
Result<void> findAgain(const SearchInput& input, const std::vector<std::uint32_t>& which, Precision precision,
                       NeighborRows& rows);

/// Replaces all cells by those of the exact search's mesh. Returns false and changes nothing if there is
/// none.
bool findAllInMesh(const SearchInput& input, NeighborRows& rows);

}  // namespace vorpipe::core
