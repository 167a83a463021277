/// What reproduces a run: how it was called, and what was in the files that it read and wrote.
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
  std::string timeless{};  ///< hash of what times leave of it; empty where it holds none
};

/// Begins before a run reads anything, so that openOutputs knows what it has read. Hashes files only where
/// somebody will read of it: `--stats` was given, or another run of this process wants to know.
class RunLog {
 public:
  RunLog(const Invocation& invocation, bool stats_wanted);

  /// Of a file that holds times, which no run has again: what is the same in every run. For the writer.
  void noteTimeless(std::string_view text);

  /// Lets `write` write, and notes what it wrote.
  Result<void> noteOutput(ByteSink& to, const std::function<Result<void>(ByteSink&)>& write);

  [[nodiscard]] const Invocation& invocation() const { return invocation_; }
  [[nodiscard]] std::vector<LoggedFile> inputs() const { return reads_.files(); }
  [[nodiscard]] const std::vector<WrittenFile>& outputs() const { return outputs_; }

  SearchOptions search{};
  int threads = 0;     ///< as asked for; 0: all
  std::string choice;  ///< why a backend was taken; empty where it was named

 private:
  const Invocation& invocation_;
  bool hashes_;
  ReadLog reads_;
  std::vector<WrittenFile> outputs_;
  std::string timeless_;  ///< of the file that is being written
};

}  // namespace vorpipe::cli
