/// Whether a run fits into the memory that there is, told before it begins.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "cli/runs/input.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Plans what a run takes beside its input: sessions, what they compute, checks and files.
using PlanRun = std::function<void(MemoryPlan&, const Workload&)>;

/// Refuses (input) the sites of a generator that will not fit whatever the device is, before they are made.
/// Where `limit` is given, that is the most.
Result<void> forecastGenerated(const InputOptions& options, const PlanRun& plan,
                               std::optional<std::uint64_t> limit);

/// Bytes at the peak of a run over this input on a device. Errors (input): more than there are, or than
/// `limit`; those of sitesAndImages. `purpose` is what images are for.
Result<std::uint64_t> forecastRun(const InputOptions& options, const Input& input, ImagesFor purpose,
                                  const DeviceInfo& device, const BackendOptions& backend,
                                  const PlanRun& plan, std::optional<std::uint64_t> limit);

/// Why a run that needs `bytes` bytes does not fit into `limit` and the system's memory; nothing if it does.
std::optional<std::string> lackOfMemory(std::uint64_t bytes, std::optional<std::uint64_t> limit);

}  // namespace vorpipe::cli
