/// The JSON of --stats: what makes a run reproducible and its figures; also read again, to repeat the run.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/input.h"
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

/// The call of a run, and hashes of the files that it read and wrote. Create it before a run reads anything,
/// so that createFiles knows the files read. Hashes files only if the hashes are used: `--stats` was given,
/// or another run of this process needs them.
class RunLog {
 public:
  RunLog(const Invocation& invocation, bool stats_wanted);

  /// Calls `write`, and records what it wrote.
  Result<void> noteOutput(ByteSink& to, const std::function<Result<void>(ByteSink&)>& write);

  /// Writes a text with times, within noteOutput; records the hash of the same text without them.
  Result<void> writeTimed(ByteSink& to, const std::function<std::string(bool with_times)>& text);

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

struct Stats {
  std::string command;
  const Input& input;
  const Report& report;
  const RunLog& log;
  double write_ms, total_ms;
  std::uint64_t forecast;  ///< bytes at the peak, forecast before the run
  /// Replaces the null of "area_sum", "mass_sum" and "color", and adds what the subcommand alone has.
  std::function<void(nlohmann::ordered_json&)> addFigures;
};

/// Sets "area_sum", and "mass_sum" if there are masses.
void addSums(nlohmann::ordered_json& json, const Diagram& diagram);

/// Returns the numbers of cells and pixels by what resolved them.
nlohmann::ordered_json resolvedJson(const Report& report);

/// Adds the domain's properties besides its box, and the range of the weights: "outline", "periodic",
/// "projection" and "weights", each null if there is none.
void addShape(nlohmann::ordered_json& json, const Input& input);

/// Returns the object that `--stats` writes, with a line end; a figure that does not apply is null.
std::string statsJson(const Stats& stats);

/// What is needed to repeat a run.
struct RecordedRun {
  std::vector<std::string> arguments;  ///< without the program's name; the first is the subcommand
  std::vector<LoggedFile> inputs;
  std::vector<WrittenFile> outputs;
  std::string version, revision, backend, device;  ///< empty if unknown
};

/// Reads the output of statsJson; errors begin with `name`. Errors (input): it is no JSON, or no such object,
/// or of an older version that did not record enough.
Result<RecordedRun> recordedRun(const std::string& name, std::string_view json);

}  // namespace vorpipe::cli
