/// All scenes on all devices.
#pragma once

#include <span>

#include "selftest/runs.h"
#include "selftest/scene.h"
#include "vorpipe/selftest.h"

namespace vorpipe::selftests {

/// A usable device, and how to open it.
struct Tested {
  std::size_t device;  ///< index in SelftestReport::devices
  OpenRuns open;
  bool is_judge;  ///< the backend that all others are compared with
  bool masked;    ///< whether masks have an effect on it
};

/// Runs scenes of all `kinds` on all devices of `tested`. Fills in the runs and the arithmetic of each device
/// in `report`. `judge` opens the backend that they are compared with. Errors: the progress asked to stop
/// (cancelled); the judge cannot be opened (device).
Result<void> runScenes(std::span<const SceneKind> kinds, const std::vector<Tested>& tested,
                       const OpenRuns& judge, const SelftestOptions& options, SelftestReport& report);

/// The first number in `measured` that breaks one of vorpipe's bounds, in words; empty if all keep them.
/// `subpixel_bits` are those that the device reports.
std::string arithmeticFault(const Arithmetic& measured, int subpixel_bits);

}  // namespace vorpipe::selftests
