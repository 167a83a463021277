/// How much memory a fluid will take.
#pragma once

#include <cstdint>
#include <optional>

#include "cli/options/fluid_options.h"
#include "cli/options/picture_options.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {

/// What a forecast asks of the command line.
struct FluidPlan {
  const FluidChoices& choices;
  const FluidTargets& targets;
  const PictureOptions& picture;
  std::optional<std::uint64_t> limit;
};

/// Refuses (input) a named case whose cells will not fit whatever the device is, before it is made.
Result<void> forecastCase(const FluidPlan& plan);

/// Bytes at the peak of a run. Errors (input): more than there are, or than the limit; those of workloadOf.
Result<std::uint64_t> forecastFluid(const FluidPlan& plan, const FluidSetup& setup, const DeviceInfo& device,
                                    int threads);

}  // namespace vorpipe::cli
