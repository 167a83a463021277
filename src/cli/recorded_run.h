/// What a file of --stats tells of a run, so that it can be run again.
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
  std::string version, revision, backend, device;  ///< empty where it was not known
};

/// Reads what statsJson wrote; `name` is how errors begin. Errors (input): it is no JSON, or no such object,
/// or that of a version that did not tell so much.
Result<RecordedRun> recordedRun(const std::string& name, std::string_view json);

/// The same of a file. Errors: those of InputFile besides.
Result<RecordedRun> readRecordedRun(const std::string& path);

}  // namespace vorpipe::cli
