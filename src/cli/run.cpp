#include "cli/run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>

#include "base/try.h"
#include "bench/driver_threads.h"
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

void addCommonOptions(Options& options, RunOptions& run, const std::string& check) {
  addBackendChoice(options, run.backend);
  addSearchOptions(options, run.search);
  addRunOptions(options, run.backend, run.memory_limit);
  if (!check.empty()) {
    options.group("Run");
    options.addFlag("--check", run.check, check);
  }
  options.group("Output");
  addStats(options, run.stats);
  addTalkOptions(options, run.talk, run.backend.waiting);
}

CommandRun::CommandRun(std::string name, const RunOptions& run_options, const Invocation& invocation,
                       std::vector<std::string> output_paths)
    : options(run_options),
      log(invocation, !options.stats.empty()),
      paths(std::move(output_paths)),
      name_(std::move(name)) {
  setDriverThreads(options.backend.threads);
  log.search = options.search;
  log.threads = options.backend.threads;
  if (!options.stats.empty()) paths.push_back(options.stats);
}

Result<void> CommandRun::needsOutput(std::string_view example, std::string_view others) const {
  if (!paths.empty() || options.check || log.invocation().stats != nullptr) return {};
  return inputError(fmt::format("-o: name what to write, as in -o {} (or give {})", example, others));
}

Result<Input> CommandRun::load(const InputOptions& input, const PlanRun& plan,
                               std::string_view advice) const {
  VORPIPE_TRY(forecastGenerated(input, plan, options.memory_limit, advice));
  return loadInput(input);
}

Result<void> CommandRun::createFiles() {
  auto created = cli::createFiles(paths);
  if (created) files = std::move(*created);
  return created.map([](const auto&) {});
}

Result<void> CommandRun::openSession() {
  VORPIPE_VAR(opened, Session::open(options.backend));
  session = std::move(opened);
  log.choice = session->choice();
  return {};
}

Result<void> CommandRun::begin(const InputOptions& input_options, const Input& input, ImagesFor purpose,
                               const PlanRun& plan, std::string_view advice) {
  printNotes(options.talk, input);
  VORPIPE_TRY(createFiles());
  VORPIPE_TRY(openSession());
  const auto bytes = forecastRun(input_options, input, purpose, session->device(), options.backend, plan,
                                 options.memory_limit, advice);
  if (bytes) forecast = *bytes;
  return bytes.map([](std::uint64_t) {});
}

Result<void> CommandRun::write(const RunOutput& output) {
  const auto stats = [&] {
    return statsJson({name_, output.input, output.report, log, output.since.milliseconds(),
                      total_.milliseconds(), forecast, output.figures});
  };
  std::vector<Writer> writers;
  for (const Writer& writer : output.writers)
    writers.emplace_back([&](ByteSink& to) { return log.noteOutput(to, writer); });
  if (!options.stats.empty()) writers.emplace_back([&](ByteSink& to) { return to.write(stats()); });
  VORPIPE_TRY(writeOutputs(files, writers));
  if (log.invocation().stats != nullptr) *log.invocation().stats = stats();
  return {};
}

std::string CommandRun::outcome(const Sites& sites, const Report& report) const {
  return fmt::format("{}{}{} {} cells ({} empty, {} duplicate)", fmt::join(paths, ", "),
                     paths.empty() ? "" : ": ", report.ok, sites.weight.empty() ? "unweighted" : "weighted",
                     report.empty, report.duplicate);
}

void CommandRun::printSummary(std::string_view what, const Report& report) const {
  const std::string line = fmt::format("{}, {} on {}, {:.3f} s{}\n", what, report.backend, report.device,
                                       total_.seconds(), options.check ? ", checked" : "");
  cli::printSummary(options.talk, paths, line);
  if (options.talk.verbose && !log.choice.empty()) printNote(log.choice);
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
  for (const std::string& note : input.notes) printNote(note);
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

Result<std::vector<OutputFile>> createFiles(std::span<const std::string> paths) {
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

}  // namespace vorpipe::cli
