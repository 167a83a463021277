/// From the caller's sites to a SiteSet: checked, scaled, unique, in the bins of a grid.
#pragma once

#include "backend/backend.h"

namespace vorpipe {

struct Prepared {
  SiteSet set;
  int exponent = 0;  ///< scaled units are the input's times 2^exponent
  /// By input index: of the sites with the same position the heaviest, of these the lowest.
  std::vector<std::uint32_t> owner;
};

/// Checks sites and domain and orders the sites by the bins of a grid. The scale is a power of two, so
/// that what is a tie in the input stays one. Errors (input): no sites, more than 2^31 - 1, a
/// coordinate that is not finite or is more than 2^300 domains away, a weight that scaledWeights refuses,
/// a domain without area, two sites that are not equal but nearer to each other than 2^-80 of the domain.
Result<Prepared> prepare(const Sites& sites, const Box& domain, int threads);

/// Checks the number of neighbors. Error (input): fewer than 3 or more than 1024.
Result<void> checkSearch(const SearchOptions& search);

/// Checks that a search takes the weights of a set, if it has some. Error (input): FLANN does not.
Result<void> checkSearch(const SearchOptions& search, const SiteSet& set);

}  // namespace vorpipe
