/// From the caller's sites to a SiteSet: checked, scaled, unique, in the bins of a grid.
#pragma once

#include <functional>
#include <span>

#include "sites/bin_sort.h"
#include "sites/grid.h"

namespace vorpipe::core {

struct Prepared {
  SiteSet set;
  int exponent = 0;  ///< scaled units are the input's times 2^exponent
  /// By input index: the heaviest site at the same position; of equally heavy ones, the lowest index.
  std::vector<std::uint32_t> owner;
};

/// Errors (input): no sites, more than 2^31 - 1, a coordinate that is not finite or is more than 2^300
/// domains away, a weight that scaledWeights refuses, a domain without area.
Result<void> checkSites(const Sites& sites, const Box& domain, int threads);

/// The caller's sites. Errors name these if a run has images of them as well.
struct CallersSites {
  const Sites& sites;
  std::function<std::uint32_t(std::uint32_t)> siteOf;  ///< by index in the run's sites
  Box domain;  ///< of the caller's sites, in the units of the run's sites
};

/// Checks sites and domain and orders the sites by the bins of a grid. The scale is a power of two, so that
/// what is a tie in the input stays one. Errors (input): those of checkSites, two sites that are unequal but
/// nearer to each other than 2^-80 of the domain.
Result<Prepared> prepare(const Sites& sites, const Box& domain, int threads,
                         const CallersSites* callers = nullptr);

/// The same in one bin, in the order of the input, for who triangulates them and searches no bins; sites may
/// be as near to each other as 2^-140 of the domain.
Result<Prepared> prepareInOneBin(const Sites& sites, const Box& domain, int threads);

/// How to prepare a part of a run's sites, which have no weights, so that all results are the same as in the
/// whole run.
struct PartOfRun {
  int exponent;                          ///< of the whole run
  Box domain;                            ///< what the part's cells are clipped to, in scaled units
  double shorter_side;                   ///< of the whole domain
  Grid grid;                             ///< without offsets
  BlockOfGrid block{};                   ///< the grid that `grid` is a part of, if it is one
  std::span<const std::uint32_t> names;  ///< of the part's sites in the whole run, for messages
};

/// Orders sites, already known to be finite, by the bins of their part. Error (input): two are nearer to each
/// other than prepare() allows.
Result<Prepared> preparePart(const Sites& sites, const PartOfRun& part, int threads);

}  // namespace vorpipe::core
