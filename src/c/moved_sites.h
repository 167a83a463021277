/// Sites that have moved or got other weights: as files, as inputs of further runs, and what was done to
/// them.
#pragma once

#include <string>

#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// With what was known of them before.
struct MovedSites {
  const vorpipe_input& input;
  const PlacedInput& placed;
  const Sites& sites;  ///< in the plane of a projection
};

/// Writes them to the caller as a file of that format. Errors: those of pointsFormatOf and writePoints.
vorpipe_code writeMoved(const MovedSites& moved, const char* format, vorpipe_write write, void* user);

/// The same to a path, by its extension.
vorpipe_code saveMoved(const MovedSites& moved, const char* path);

/// Makes them an input, whose domain stays as it was found.
vorpipe_code giveMoved(const MovedSites& moved, Surface surface, vorpipe_input** input);

/// Gives a run's report; its strings stay where they are.
vorpipe_code giveReport(const Report& report, vorpipe_report* to);

}  // namespace vorpipe::c
