/// All scenes on all devices.
#pragma once

#include <span>

#include "selftest/runs.h"
#include "selftest/scene.h"
#include "vorpipe/selftest.h"

namespace vorpipe::selftests {

/// A device that can be used, and how it is opened.
struct Tested {
  std::size_t device;  ///< its place in the report
  OpenRuns open;
  bool is_judge;  ///< the backend that all others are compared with
  bool masked;    ///< whether masks mean anything to it
};

/// Runs scenes of those kinds and fills in what became of them, and the arithmetic of the devices; `judge`
/// opens what they are compared with. Error (cancelled): the progress said so; (device): the judge cannot be
/// opened.
Result<void> runScenes(std::span<const SceneKind> kinds, const std::vector<Tested>& tested,
                       const OpenRuns& judge, const SelftestOptions& options, SelftestReport& report);

/// What of the numbers is worse than vorpipe's bounds allow, for a device that says it has so many sub-pixel
/// bits; empty if nothing.
std::string arithmeticFault(const Arithmetic& measured, int subpixel_bits);

}  // namespace vorpipe::selftests
