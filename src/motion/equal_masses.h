/// Sites that move a little, so that their cells have equal masses without weights.
#pragma once

#include <cstdint>

#include "vorpipe.h"

namespace vorpipe::moving {

struct EqualMasses {
  Sites sites;
  std::uint64_t diagrams = 0;  ///< that it took
  double worst = 0;            ///< largest |mass - mean| / mean that is left
};

/// Moves sites, all together as little as masses allow to first order, until no cell differs from the mean
/// mass by more than `tolerance`, or `most` diagrams are computed, or no step brings more. Sites without mass
/// stay. Sites are best in memoryOrder(). Errors: those of Session::cells.
Result<EqualMasses> equalizeMasses(Session& session, Sites sites, const CellsOptions& options,
                                   double tolerance, std::uint64_t most);

}  // namespace vorpipe::moving
