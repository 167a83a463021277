#include "cli/run_end.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>

#include "base/try.h"
#include "cli/options/error_line.h"
#include "cli/progress.h"
#include "io/base/error.h"
#include "io/base/read_log.h"

namespace vorpipe::cli {
namespace {

/// Whether a path leads to standard output, as /dev/stdout does.
bool isStandardOutput(const std::string& path) {
  struct stat there {
  }, here{};
  return stat(path.c_str(), &there) == 0 && fstat(STDOUT_FILENO, &here) == 0 && there.st_dev == here.st_dev &&
         there.st_ino == here.st_ino;
}

}  // namespace

Error nothingToDo(std::string_view example) {
  return {ErrorCode::input,
          fmt::format("-o: name what to write, as in -o {} (or give --stats or --check)", example)};
}

bool validationIsSilent(const Report& report, std::string_view name) {
  if (report.validation_messages.empty()) return true;
  printError(fmt::format("validation: {}{}{}", name, name.empty() ? "" : ": ",
                         fmt::join(report.validation_messages, "; ")));
  return false;
}

void printNotes(const TalkOptions& talk, const Report& report, std::string_view name) {
  if (talk.quiet) return;
  for (const std::string& note : report.notes) {
    printNote(fmt::format("{}{}{}", name, name.empty() ? "" : ": ", note));
  }
}

void printNotes(const TalkOptions& talk, const Input& input) {
  if (talk.quiet) return;
  for (const std::string& note : input.notes) printError("note: " + note);
}

Result<bool> passesCheck(const Result<std::vector<std::string>>& broken) {
  if (!broken) return tl::unexpected(broken.error());
  if (!broken->empty()) printError(fmt::format("--check: {}", fmt::join(*broken, "; ")));
  return broken->empty();
}

Result<void> checkNotRead(std::span<const std::string> paths) {
  const ReadLog* const reads = ReadLog::current();
  for (const std::string& path : paths) {
    const std::string* const name = reads != nullptr ? reads->nameOf(path) : nullptr;
    if (name == nullptr) continue;
    return inputError(fmt::format("{}: is an input of this run{}, and would be replaced; name another file",
                                  path, *name == path ? "" : fmt::format(", read as {}", *name)));
  }
  return {};
}

Result<std::vector<OutputFile>> openOutputs(std::span<const std::string> paths) {
  VORPIPE_TRY(checkNotRead(paths));
  stopOnSignals();
  return createOutputs(paths);
}

Result<void> writeOutputs(std::span<OutputFile> files, std::span<const Writer> writers) {
  assert(files.size() == writers.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    VORPIPE_TRY(writers[i](files[i]));
  }
  ignoreSignals();
  VORPIPE_TRY(stopIfAsked());
  return commitAll(files);
}

Result<void> writeOutputs(std::span<OutputFile> files, std::span<const Writer> writers, RunLog& log,
                          const std::function<std::string()>& stats) {
  std::vector<Writer> noted;
  for (const Writer& writer : writers)
    noted.emplace_back([&](ByteSink& to) { return log.noteOutput(to, writer); });
  if (files.size() > writers.size()) noted.emplace_back([&](ByteSink& to) { return to.write(stats()); });
  auto written = writeOutputs(files, noted);
  if (written && log.invocation().stats != nullptr) *log.invocation().stats = stats();
  return written;
}

void printMissingCells(const TalkOptions& talk, const Input& input, std::span<const Status> status,
                       const Report& report) {
  if (talk.quiet || report.empty == 0) return;
  const Box& box = input.domain;
  // Sites of a periodic domain are moved into it.
  const bool has_outside = input.periodic == Periodic::none;
  std::uint64_t outside = 0;
  for (std::size_t i = 0; has_outside && i < status.size(); ++i) {
    const double x = input.sites.x[i], y = input.sites.y[i];
    const bool inside = x >= box.xmin && x <= box.xmax && y >= box.ymin && y <= box.ymax;
    if (status[i] == Status::empty && !inside) ++outside;
  }
  // Sites that are not hidden in the box of an outline may still have no cell inside the outline.
  const std::uint64_t hidden = report.hidden - std::min(report.hidden, outside);
  const auto say = [&](std::uint64_t count, std::string_view why) {
    if (count > 0) printNote(fmt::format("{} of {} sites have no cell: {}", count, input.sites.size(), why));
  };
  say(hidden, "others of larger weight hide them");
  say(report.empty - hidden, "they lie outside the domain");
}

void printSummary(const TalkOptions& talk, std::span<const std::string> paths, std::string_view lines) {
  if (!talk.quiet && std::ranges::none_of(paths, isStandardOutput)) fmt::print("{}", lines);
}

std::string outcomeText(std::span<const std::string> paths, const Sites& sites, const Report& report) {
  return fmt::format("{}{}{} {} cells ({} empty, {} duplicate)", fmt::join(paths, ", "),
                     paths.empty() ? "" : ": ", report.ok, sites.weight.empty() ? "unweighted" : "weighted",
                     report.empty, report.duplicate);
}

std::string runText(const Report& report, double milliseconds, bool checked) {
  return fmt::format("{} on {}, {:.3f} s{}", report.backend, report.device, milliseconds / 1000,
                     checked ? ", checked" : "");
}

}  // namespace vorpipe::cli
