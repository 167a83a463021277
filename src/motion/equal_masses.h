/// Moves sites a little, so that their cells have equal masses without weights.
#pragma once

#include <cstdint>

#include "vorpipe.h"

namespace vorpipe::moving {

struct EqualMasses {
  Sites sites;
  std::uint64_t diagrams = 0;  ///< number computed
  double worst = 0;            ///< largest remaining |mass - mean| / mean
};

/// Moves sites as little as possible in total, with masses taken to first order. Stops when no cell differs
/// from the mean mass by more than `tolerance`, when `most` diagrams are computed, or when no step improves.
/// Sites without mass stay. Sites are best in memoryOrder(). Errors: those of Session::cells.
Result<EqualMasses> equalizeMasses(Session& session, Sites sites, const CellsOptions& options,
                                   double tolerance, std::uint64_t most);

}  // namespace vorpipe::moving
