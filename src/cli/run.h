/// A run of a subcommand: its options, input, output files, session and summary.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/stopwatch.h"
#include "cli/forecast.h"
#include "cli/input.h"
#include "cli/options/options.h"
#include "cli/stats.h"
#include "io/base/byte_sink.h"
#include "io/base/output_file.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// The options of every subcommand with --stats.
struct RunOptions {
  BackendOptions backend;
  TalkOptions talk;
  SearchOptions search;
  bool check = false;
  std::string stats;  ///< a file
  std::optional<std::uint64_t> memory_limit;
};

/// --backend, --search, those of addRunOptions, --check unless its description is empty, --stats, --quiet,
/// --verbose
void addCommonOptions(Options& options, RunOptions& run, const std::string& check = {});

/// Writes one file.
using Writer = std::function<Result<void>(ByteSink&)>;

/// What a run writes at its end.
struct RunOutput {
  const Input& input;
  const Report& report;
  std::vector<Writer> writers{};                           ///< for the files besides --stats, in their order
  std::function<void(nlohmann::ordered_json&)> figures{};  ///< as in Stats
  Stopwatch since{};                                       ///< the time of writing
};

/// What the subcommands that compute have in common, in the order of use.
class CommandRun {
 public:
  /// Construct it before anything is read. `paths` are the output files besides --stats, in the order in
  /// which they are created.
  CommandRun(std::string name, const RunOptions& options, const Invocation& invocation,
             std::vector<std::string> paths);

  /// Error (input): there is nothing to write or check. The message names an `example` of a file, and
  /// `others` in place of -o.
  [[nodiscard]] Result<void> needsOutput(std::string_view example, std::string_view others) const;

  /// Loads the input. Errors: those of forecastGenerated and loadInput.
  [[nodiscard]] Result<Input> load(const InputOptions& input, const PlanRun& plan,
                                   std::string_view advice = {}) const;

  /// Creates the output files: see vorpipe::cli::createFiles.
  Result<void> createFiles();
  Result<void> openSession();
  /// Prints the notes of the input, does both of the above, and forecasts the memory. Errors: also those of
  /// forecastRun.
  Result<void> begin(const InputOptions& options, const Input& input, ImagesFor purpose, const PlanRun& plan,
                     std::string_view advice = {});

  /// Writes all files or none. Errors: those of writeOutputs.
  Result<void> write(const RunOutput& output);

  /// Returns "a.png, b.npy: 10 weighted cells (0 empty, 0 duplicate)"; without weights, "unweighted".
  [[nodiscard]] std::string outcome(const Sites& sites, const Report& report) const;
  /// Prints a line such as "WHAT, cpu on NAME, 0.100 s, checked" on standard output, unless the run is quiet
  /// or one of its files goes there; with --verbose also why a backend was chosen.
  void printSummary(std::string_view what, const Report& report) const;

  const RunOptions& options;
  RunLog log;
  std::vector<std::string> paths;  ///< with --stats
  std::vector<OutputFile> files{};
  std::optional<Session> session{};
  std::uint64_t forecast = 0;  ///< bytes at the peak

 private:
  std::string name_;
  Stopwatch total_;
};

/// Creates output files. From now on a signal stops the run, which then leaves none of them. Call after all
/// inputs were read. Errors: those of checkNotRead and createOutputs.
Result<std::vector<OutputFile>> createFiles(std::span<const std::string> paths);

/// Error (input): a path leads to a file that this run has read, according to ReadLog::current().
Result<void> checkNotRead(std::span<const std::string> paths);

/// Writes each file with the writer of the same index, and puts all in place together. Errors: those of the
/// writers; a signal has asked to stop. A later signal has no effect.
Result<void> writeOutputs(std::span<OutputFile> files, std::span<const Writer> writers);

/// Prints the messages of the validation layers, in one line, after `name`. Returns whether there were none.
bool validationIsSilent(const Report& report, std::string_view name = {});

/// Prints each deviation from the run's start in a line on standard error, unless the run is quiet: e.g.
/// another backend than the first choice did the work. `name` as above.
void printNotes(const TalkOptions& talk, const Report& report, std::string_view name = {});

/// The same for changes and reinterpretations of the input.
void printNotes(const TalkOptions& talk, const Input& input);

/// Prints the findings of check(), in one line. Returns whether all promises hold. Error: check()'s.
Result<bool> passesCheck(const Result<std::vector<std::string>>& broken);

/// Prints how many sites have no cell, with a line for each reason, on standard error, unless the run is
/// quiet. `status` has that of each site.
void printMissingCells(const TalkOptions& talk, const Input& input, std::span<const Status> status,
                       const Report& report);

/// Prints lines on standard output, unless the run is quiet or one of its files goes there.
void printSummary(const TalkOptions& talk, std::span<const std::string> paths, std::string_view lines);

}  // namespace vorpipe::cli
