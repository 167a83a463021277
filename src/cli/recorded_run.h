/// Reads from a --stats file what is needed to repeat a run.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/run_log.h"
#include "io/base/read_log.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct RecordedRun {
  std::vector<std::string> arguments;  ///< without the program's name; the first is the subcommand
  std::vector<LoggedFile> inputs;
  std::vector<WrittenFile> outputs;
  std::string version, revision, backend, device;  ///< empty if unknown
};

/// Reads the output of statsJson; errors begin with `name`. Errors (input): it is no JSON, or no such object,
/// or of an older version that did not record enough.
Result<RecordedRun> recordedRun(const std::string& name, std::string_view json);

/// The same for a file. Errors: also those of InputFile.
Result<RecordedRun> readRecordedRun(const std::string& path);

}  // namespace vorpipe::cli
