/// Results as files, and moved sites as inputs of further runs.
#pragma once

#include <string>
#include <utility>

#include "c/handles.h"
#include "c/vorpipe_c.h"
#include "io/base/byte_sink.h"
#include "io/base/output_file.h"
#include "vorpipe.h"

namespace vorpipe::c {

/// Passes bytes to the caller's function; `name` stands for the file.
inline CallbackSink sinkOf(std::string name, vorpipe_write write, void* user) {
  return {std::move(name),
          [write, user](std::string_view bytes) { return write(user, bytes.data(), bytes.size()) == 0; }};
}

/// Moved sites with their original input.
struct MovedSites {
  const vorpipe_input& input;
  const PlacedInput& placed;
  const Sites& sites;  ///< in the plane of a projection
};

/// Writes them to the caller in this file format. Errors: those of pointsFormatOf and writePoints.
vorpipe_code writeMoved(const MovedSites& moved, const char* format, vorpipe_write write, void* user);

/// The same to a path; its extension gives the format.
vorpipe_code saveMoved(const MovedSites& moved, const char* path);

/// Makes an input of them; its domain does not change.
vorpipe_code giveMoved(const MovedSites& moved, Surface surface, vorpipe_input** input);

/// Returns a run's report; its strings stay where they are.
vorpipe_code giveReport(const Report& report, vorpipe_report* to);

}  // namespace vorpipe::c
