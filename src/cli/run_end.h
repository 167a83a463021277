/// The end of a run: notes about its result, and its output files.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/input.h"
#include "cli/options/options.h"
#include "cli/run_log.h"
#include "io/base/byte_sink.h"
#include "io/base/output_file.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Returns the error of a run without any output; `example` is a file that it could write.
Error nothingToDo(std::string_view example);

/// Prints the messages of the validation layers, in one line, after `name`. Returns whether there were none.
bool validationIsSilent(const Report& report, std::string_view name = {});

/// Prints each deviation from the run's start in a line on standard error, unless the run is quiet: e.g.
/// another backend than the first choice did the work. `name` as above.
void printNotes(const TalkOptions& talk, const Report& report, std::string_view name = {});

/// The same for changes and reinterpretations of the input.
void printNotes(const TalkOptions& talk, const Input& input);

/// Prints the findings of check(), in one line. Returns whether all promises hold. Error: check()'s.
Result<bool> passesCheck(const Result<std::vector<std::string>>& broken);

/// Error (input): a path leads to a file that this run has read, according to ReadLog::current().
Result<void> checkNotRead(std::span<const std::string> paths);

/// Creates the output files of a run. From now on a signal stops the run, which then leaves none of them.
/// Call after all inputs were read. Errors: those of checkNotRead and vorpipe::createOutputs.
Result<std::vector<OutputFile>> openOutputs(std::span<const std::string> paths);

/// Writes one file.
using Writer = std::function<Result<void>(ByteSink&)>;

/// Writes each file with the writer of the same index, and puts all in place together. Errors: those of the
/// writers; a signal has asked to stop. A later signal has no effect.
Result<void> writeOutputs(std::span<OutputFile> files, std::span<const Writer> writers);

/// The same for a run with --stats; `stats` makes their text after all else is written. It goes into the last
/// file, if there is one more than writers, and to the invocation if that asks.
Result<void> writeOutputs(std::span<OutputFile> files, std::span<const Writer> writers, RunLog& log,
                          const std::function<std::string()>& stats);

/// Prints how many sites have no cell, with a line for each reason, on standard error, unless the run is
/// quiet. `status` has that of each site.
void printMissingCells(const TalkOptions& talk, const Input& input, std::span<const Status> status,
                       const Report& report);

/// Prints a run's summary lines on standard output, unless the run is quiet or one of its files goes there.
void printSummary(const TalkOptions& talk, std::span<const std::string> paths, std::string_view lines);

/// Returns how summaries begin: "a.png, b.npy: 10 weighted cells (0 empty, 0 duplicate)"; without weights,
/// "unweighted".
std::string outcomeText(std::span<const std::string> paths, const Sites& sites, const Report& report);

/// Returns how summaries end: "cpu on NAME, 0.100 s, checked".
std::string runText(const Report& report, double milliseconds, bool checked);

}  // namespace vorpipe::cli
