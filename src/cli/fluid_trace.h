/// The --trace of a fluid, which grows with its steps.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/run_log.h"
#include "io/base/output_file.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {

/// A row for each step, in its file as soon as the step is made: a run that is killed has the rows of the
/// steps that it made.
class FluidTrace {
 public:
  /// Opens the trace at `path`; an empty path makes none. With `resumed`, the state of a checkpoint, a file
  /// that is there is kept up to the step of that state; else the trace begins anew. Writes nothing yet.
  /// Errors: those of reading; the file is no trace, or has no such step (input).
  static Result<FluidTrace> open(const std::string& path, const FluidState* resumed);
  FluidTrace(FluidTrace&& other) noexcept;
  FluidTrace& operator=(FluidTrace&& other) = delete;
  ~FluidTrace();

  /// The first step is the one that the fluid begins at, which a continued trace has already. Errors:
  /// those of OutputFile; (device) the system does not take it: the file has the rows before.
  Result<void> add(const FluidStep& step);

  /// Hands all to the system, and notes for the log what is in the file.
  Result<void> finish(RunLog& log);

 private:
  explicit FluidTrace(std::string path) : path_(std::move(path)) {}
  Result<void> begin();
  Result<void> append(const std::string& row);

  std::string path_;
  bool goes_on_ = false;
  std::string text_, timeless_;       ///< all of it, and without the clock's times
  std::optional<OutputFile> direct_;  ///< of what is no regular file
  int descriptor_ = -1;
};

}  // namespace vorpipe::cli
