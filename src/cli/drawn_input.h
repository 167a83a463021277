/// The density of a run, and sites that may be drawn from it, as `--sites density:N` asks for them.
#pragma once

#include <cstdint>
#include <optional>

#include "cli/forecast.h"
#include "cli/input.h"
#include "cli/options/options.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// How many sites `density:N` asks for; none where the sites are named otherwise. Error (input): N is no
/// number of sites.
Result<std::optional<std::uint64_t>> drawnCount(const InputOptions& options);

/// The options with a generator of as many sites in the place of `density:N`, and where no domain is named,
/// the box of the density's pixels: what the rest of a run needs to know. Errors (input): there is no
/// density; the domain is asked of the sites.
Result<InputOptions> asGenerator(const InputOptions& options, std::uint64_t count, const Density& density);

/// Draws the sites anew, in the domain of the input.
Result<void> drawSites(Input& input, const Density& density, const InputOptions& options);

/// Reads, generates or draws the sites; `options` are left as the rest of the run takes them. Errors: those
/// of the functions above, forecastGenerated, loadInput and placeUnder.
Result<Input> inputUnder(const DensityFile& density, const DensityOptions& from, InputOptions& options,
                         const PlanRun& plan, std::optional<std::uint64_t> memory_limit);

}  // namespace vorpipe::cli
