/// Judges whether the results of a device are right.
#pragma once

#include <string>
#include <vector>

#include "selftest/runs.h"
#include "selftest/scene.h"

namespace vorpipe::selftests {

/// A picture and cells of one scene, or the errors instead.
struct Answers {
  Result<Rendering> picture;
  Result<Diagram> cells;
  double milliseconds;
};

Answers answer(Runs& runs, const Scene& scene, const Progress& progress);

/// Whether the caller's progress stopped the run.
bool wasCancelled(const Answers& answers);

/// The notes in the runs' reports.
std::vector<std::string> notesOf(const Answers& answers);

/// The first fault that check() finds in them, in one line; empty if none. `refusable`: refusing the scene as
/// input is correct. Any other missing answer (an error) is a fault.
std::string faultByCheck(const Answers& answers, const Scene& scene, bool refusable, int threads);

/// How they differ from the judge's answers, in one line; empty if they do not. Where the judge has no
/// answers, there is no difference.
std::string faultByJudge(const Answers& answers, const Answers& judges, const Scene& scene);

}  // namespace vorpipe::selftests
