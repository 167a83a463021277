/// Forecasts the memory of a fluid.
#pragma once

#include <cstdint>
#include <optional>

#include "cli/options/fluid_options.h"
#include "cli/options/picture_options.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {

/// The command-line options that a forecast needs.
struct FluidPlan {
  const FluidChoices& choices;
  const FluidTargets& targets;
  const PictureOptions& picture;
  std::optional<std::uint64_t> limit;
};

/// Error (input): the cells of a named case will not fit on any device. Call before the case is made.
Result<void> forecastCase(const FluidPlan& plan);

/// Returns the peak memory of a run, in bytes. Errors (input): more than available, or than the limit; those
/// of workloadOf.
Result<std::uint64_t> forecastFluid(const FluidPlan& plan, const FluidSetup& setup, const DeviceInfo& device,
                                    int threads);

}  // namespace vorpipe::cli
