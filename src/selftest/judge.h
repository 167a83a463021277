/// Whether what a device answered is right.
#pragma once

#include <string>
#include <vector>

#include "selftest/runs.h"
#include "selftest/scene.h"

namespace vorpipe::selftests {

/// A picture and cells of one scene, or why they are not there.
struct Answers {
  Result<Rendering> picture;
  Result<Diagram> cells;
  double milliseconds;
};

Answers answer(Runs& runs, const Scene& scene, const Progress& progress);

/// Whether the caller's progress stopped the run.
bool wasCancelled(const Answers& answers);

/// What the runs' reports note.
std::vector<std::string> notesOf(const Answers& answers);

/// What check() finds in them first, in one line; empty if nothing. `refusable`: that the scene is refused
/// as input is right. Answers that no device gave, as an error, are a fault.
std::string faultByCheck(const Answers& answers, const Scene& scene, bool refusable, int threads);

/// How they differ from the judge's, in one line; empty if they do not. Answers that the judge has none for
/// cannot differ.
std::string faultByJudge(const Answers& answers, const Answers& judges, const Scene& scene);

}  // namespace vorpipe::selftests
