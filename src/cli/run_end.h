/// How a run ends: what must be said of its result, and its output files.
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

/// The error of a run that was asked for nothing; `example` is a file that it could write.
Error nothingToDo(std::string_view example);

/// Prints what the validation layers said, in one line, after `name`; whether they said nothing.
bool validationIsSilent(const Report& report, std::string_view name = {});

/// Prints what did not go as it began, in a line each on standard error, unless the run is quiet: another
/// backend than the one that was taken first may have done it. `name` as above.
void printNotes(const TalkOptions& talk, const Report& report, std::string_view name = {});

/// The same for what was changed or reinterpreted of the input.
void printNotes(const TalkOptions& talk, const Input& input);

/// Prints what check() found, in one line; whether all promises hold. Error: check()'s.
Result<bool> passesCheck(const Result<std::vector<std::string>>& broken);

/// Refuses (input) paths that lead to files which this run has read, as ReadLog::current() has noted them.
Result<void> checkNotRead(std::span<const std::string> paths);

/// Creates the output files of a run that from now on stops, and leaves none of them, when a signal asks it
/// to. Call when all inputs were read. Errors: those of checkNotRead and vorpipe::createOutputs.
Result<std::vector<OutputFile>> openOutputs(std::span<const std::string> paths);

/// Writes one file.
using Writer = std::function<Result<void>(ByteSink&)>;

/// Has each file written by the writer at its place, and puts all in place together. Errors: those of
/// the writers; a signal has asked to stop. One that comes after that is too late.
Result<void> writeOutputs(std::span<OutputFile> files, std::span<const Writer> writers);

/// The same for a run with --stats, which `stats` makes when all else is written: into the last file, where
/// there is one more than writers, and as the invocation asks.
Result<void> writeOutputs(std::span<OutputFile> files, std::span<const Writer> writers, RunLog& log,
                          const std::function<std::string()>& stats);

/// Prints how many sites have no cell, and why, in a line each on standard error, unless the run is quiet.
/// `status` is that of each site.
void printMissingCells(const TalkOptions& talk, const Input& input, std::span<const Status> status,
                       const Report& report);

/// Prints the lines that sum up a run on standard output, unless it is quiet or one of its files goes there.
void printSummary(const TalkOptions& talk, std::span<const std::string> paths, std::string_view lines);

/// "a.png, b.npy: 10 weighted cells (0 empty, 0 duplicate)", as summaries begin; without weights they are
/// "unweighted".
std::string outcomeText(std::span<const std::string> paths, const Sites& sites, const Report& report);

/// "cpu on NAME, 0.100 s, checked", as summaries end.
std::string runText(const Report& report, double milliseconds, bool checked);

}  // namespace vorpipe::cli
