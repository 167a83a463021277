/// The density of a run, and sites sampled from it by `--sites density:N`.
#pragma once

#include <cstdint>
#include <optional>

#include "cli/forecast.h"
#include "cli/input.h"
#include "cli/options/options.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Returns the number of sites in `density:N`; none if --sites is something else. Error (input): N is no
/// number of sites.
Result<std::optional<std::uint64_t>> drawnCount(const InputOptions& options);

/// Returns the options for the rest of a run: a generator of `count` sites replaces `density:N`, and the box
/// of the density's pixels an unnamed domain. Errors (input): there is no density; the domain is to come from
/// the sites.
Result<InputOptions> asGenerator(const InputOptions& options, std::uint64_t count, const Density& density);

/// Samples the sites anew, in the domain of the input.
Result<void> drawSites(Input& input, const Density& density, const InputOptions& options);

/// Reads, generates or samples the sites, and changes `options` to what the rest of the run needs. Errors:
/// those of the functions above, forecastGenerated, loadInput and placeUnder.
Result<Input> inputUnder(const DensityFile& density, const DensityOptions& from, InputOptions& options,
                         const PlanRun& plan, std::optional<std::uint64_t> memory_limit);

}  // namespace vorpipe::cli
