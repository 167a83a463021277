/// From the caller's sites to a SiteSet: checked, scaled, unique, in the bins of a grid.
#pragma once

#include "backend/backend.h"

namespace vorpipe {

struct Prepared {
  SiteSet set;
  int exponent = 0;                  ///< scaled units are the input's times 2^exponent
  std::vector<std::uint32_t> owner;  ///< by input index: the lowest index with the same position
};

/// Checks sites and domain and orders the sites by the bins of a grid. The scale is a power of two, so
/// that what is a tie in the input stays one. Errors (input): no sites, more than 2^32 - 2, a
/// coordinate that is not finite or is more than 2^300 domains away, a domain without area.
Result<Prepared> prepare(const Sites& sites, const Box& domain, int threads);

/// Checks the number of neighbors. Error (input): fewer than 3 or more than 1024.
Result<void> checkSearch(const SearchOptions& search);

}  // namespace vorpipe
