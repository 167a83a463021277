/// From the caller's sites to a SiteSet: checked, scaled, unique, in the bins of a grid.
#pragma once

#include <functional>
#include <span>

#include "sites/bin_sort.h"
#include "sites/frame.h"

namespace vorpipe::core {

struct Prepared {
  SiteSet set;
  int exponent = 0;  ///< scaled units are the input's times 2^exponent
  /// By input index: of the sites with the same position the heaviest, of these the lowest.
  std::vector<std::uint32_t> owner;
};

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

/// How a part of the sites of a run, which have no weights, is prepared so that what follows is the same as
/// in the whole run.
struct PartOfRun {
  int exponent;                          ///< of the whole run
  Box domain;                            ///< what the part's cells are clipped to, in scaled units
  double shorter_side;                   ///< of the whole domain
  Grid grid;                             ///< without offsets
  BlockOfGrid block{};                   ///< the grid that `grid` is a part of, if it is one
  std::span<const std::uint32_t> names;  ///< of the part's sites in the whole run, for messages
};

/// Sites that were found to be finite, ordered by the bins of their part. Error (input): two that are nearer
/// to each other than prepare() allows.
Result<Prepared> preparePart(const Sites& sites, const PartOfRun& part, int threads);

}  // namespace vorpipe::core
