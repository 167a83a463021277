/// The --trace file of a fluid, which grows with its steps.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/stats.h"
#include "io/base/output_file.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {

/// Writes a row to the file right after each step, so that a killed run keeps the rows of its steps.
class FluidTrace {
 public:
  /// Opens the trace at `path`; an empty path makes none. With `resumed`, a checkpoint's state, an existing
  /// file is kept up to that state's step; else the trace begins anew. Writes nothing yet. Errors: those of
  /// reading; the file is no trace, or has no such step (input).
  static Result<FluidTrace> open(const std::string& path, const FluidState* resumed);
  FluidTrace(FluidTrace&& other) noexcept;
  FluidTrace& operator=(FluidTrace&& other) = delete;
  ~FluidTrace();

  /// Adds a row. The first step is the one at which the fluid begins; a continued trace has it already.
  /// Errors: those of OutputFile; (device) the system rejects the write, and the file keeps the rows before.
  Result<void> add(const FluidStep& step);

  /// Passes all rows to the system, and records the file's contents in the log.
  Result<void> finish(RunLog& log);

 private:
  explicit FluidTrace(std::string path) : path_(std::move(path)) {}
  Result<void> begin();
  Result<void> append(const std::string& row);

  std::string path_;
  bool is_continued_ = false;
  std::string text_, timeless_;       ///< the whole text, and the same without clock times
  std::optional<OutputFile> direct_;  ///< for anything but a regular file
  int descriptor_ = -1;
};

}  // namespace vorpipe::cli
