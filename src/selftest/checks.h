/// Runs a scene on a device and checks the results.
#pragma once

#include <string>
#include <vector>

#include "selftest/run_scenes.h"

namespace vorpipe::selftests {

/// A picture and cells of one scene, or the errors instead.
struct Outcome {
  Result<Rendering> picture;
  Result<Diagram> cells;
  double milliseconds;
};

Outcome compute(Runs& runs, const Scene& scene, const Progress& progress);

/// Whether the picture or the cells failed with this code.
bool failedWith(ErrorCode code, const Outcome& outcome);

/// The notes in the runs' reports.
std::vector<std::string> notesOf(const Outcome& outcome);

/// The first fault that check() finds, in one line; empty if none. `refusable`: refusing the scene as input
/// is correct. Any other error is a fault.
std::string faultByCheck(const Outcome& outcome, const Scene& scene, bool refusable, int threads);

/// The first difference from the reference backend's results, in one line; empty if none. Where the reference
/// has no result, there is no difference.
std::string faultByReference(const Outcome& outcome, const Outcome& reference, const Scene& scene);

}  // namespace vorpipe::selftests
