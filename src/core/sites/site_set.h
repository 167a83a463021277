/// From the caller's sites to a SiteSet: checked, scaled, unique, in the bins of a grid.
#pragma once

#include <functional>

#include "backend/backend.h"

namespace vorpipe::core {

struct Prepared {
  SiteSet set;
  int exponent = 0;  ///< scaled units are the input's times 2^exponent
  /// By input index: of the sites with the same position the heaviest, of these the lowest.
  std::vector<std::uint32_t> owner;
};

/// Scaled coordinates nearer to 0 are 0: exact decisions multiply four differences, of which a double could
/// not hold enough. Sites that are one by that would be too near to each other.
inline constexpr double least_coordinate = 0x1p-200;

/// The power of two that brings the domain's longer side into [1, 2).
int scaleExponent(const Box& domain);

/// Errors (input): no sites, more than 2^31 - 1, a coordinate that is not finite or is more than 2^300
/// domains away, a weight that scaledWeights refuses, a domain without area.
Result<void> checkSites(const Sites& sites, const Box& domain, int threads);

/// The caller's sites, which errors name where a run has images of them as well.
struct CallersSites {
  const Sites& sites;
  std::function<std::uint32_t(std::uint32_t)> siteOf;  ///< by index in the run's sites
  Box domain;                                          ///< theirs, in the units of the run's sites
};

/// Checks sites and domain and orders the sites by the bins of a grid. The scale is a power of two, so
/// that what is a tie in the input stays one. Errors (input): those of checkSites, two sites that are not
/// equal but nearer to each other than 2^-80 of the domain.
Result<Prepared> prepare(const Sites& sites, const Box& domain, int threads,
                         const CallersSites* callers = nullptr);

}  // namespace vorpipe::core
