/// The log that makes a run reproducible: its call, and hashes of the files that it read and wrote.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/command_line.h"
#include "io/base/byte_sink.h"
#include "io/base/read_log.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// A file that a run wrote.
struct WrittenFile {
  LoggedFile file;
  std::string timeless{};  ///< hash of its contents without times; empty if it holds no times
};

/// Create it before a run reads anything, so that openOutputs knows the files read. Hashes files only if the
/// hashes are used: `--stats` was given, or another run of this process needs them.
class RunLog {
 public:
  RunLog(const Invocation& invocation, bool stats_wanted);

  /// For writers of files with times: records the part that is the same in every run.
  void noteTimeless(std::string_view text);

  /// Calls `write`, and records what it wrote.
  Result<void> noteOutput(ByteSink& to, const std::function<Result<void>(ByteSink&)>& write);

  [[nodiscard]] const Invocation& invocation() const { return invocation_; }
  [[nodiscard]] std::vector<LoggedFile> inputs() const { return reads_.files(); }
  [[nodiscard]] const std::vector<WrittenFile>& outputs() const { return outputs_; }

  SearchOptions search{};
  int threads = 0;     ///< as requested; 0: all
  std::string choice;  ///< why a backend was chosen; empty if it was named

 private:
  const Invocation& invocation_;
  bool hashes_;
  ReadLog reads_;
  std::vector<WrittenFile> outputs_;
  std::string timeless_;  ///< of the file being written
};

}  // namespace vorpipe::cli
