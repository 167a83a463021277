#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>

#include "base/try.h"
#include "cli/commands/command.h"
#include "cli/options/error_line.h"
#include "cli/options/options.h"
#include "cli/run.h"
#include "cli/stats.h"
#include "io/base/error.h"
#include "io/base/input_file.h"
#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

struct RerunCommand {
  std::string stats;
  bool dry_run = false;
  TalkOptions talk;
};

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Reads a file of --stats. Errors: those of recordedRun and InputFile.
Result<RecordedRun> readRecordedRun(const std::string& path) {
  VORPIPE_VAR(file, InputFile::open(path));
  constexpr std::size_t most = std::size_t{1} << 24;
  VORPIPE_LET(text, readText(file, most));
  return recordedRun(file.name(), text);
}

/// Returns the arguments of the run, except --stats: its file is kept as evidence.
Result<std::vector<std::string>> argumentsAgain(const RerunCommand& command, const DeclaredProgram& program,
                                                const RecordedRun& run) {
  const auto sub = std::ranges::find(program.subcommands, run.arguments.front(), &DeclaredSubcommand::name);
  const auto has_stats = [](const DeclaredOption& option) { return option.names.back() == "--stats"; };
  if (sub == program.subcommands.end() || std::ranges::none_of(sub->options, has_stats)) {
    return inputError(fmt::format("{}: \"arguments\": no subcommand {} has --stats", command.stats,
                                  inQuotes(run.arguments.front())));
  }
  std::vector<std::string> again;
  for (std::size_t at = 0; at < run.arguments.size(); ++at) {
    const std::string& argument = run.arguments[at];
    if (argument.starts_with("--stats=")) continue;
    if (argument == "--stats") {
      ++at;
    } else {
      again.push_back(argument);
    }
  }
  const auto given = [&](std::string_view flag) { return std::ranges::find(again, flag) != again.end(); };
  if (command.talk.quiet && !given("--quiet") && !given("--verbose")) again.emplace_back("--quiet");
  return again;
}

/// Copies standard input to a file: it can be read only once, but is needed here and by the run.
Result<Contents> keepStandardInput() {
  VORPIPE_VAR(input, InputFile::open("-"));
  const File kept(std::tmpfile(), std::fclose);
  if (!kept) return systemError(ErrorCode::device, input.name(), "cannot be kept", errno);
  constexpr std::size_t piece = std::size_t{1} << 16;
  std::vector<char> bytes(piece);
  ContentHash hash;
  for (std::size_t count = piece; count == piece;) {
    VORPIPE_LET(got, input.readAsIs(bytes));
    count = got;
    hash.add({bytes.data(), count});
    if (std::fwrite(bytes.data(), 1, count, kept.get()) != count) {
      return systemError(ErrorCode::device, input.name(), "cannot be kept", errno);
    }
  }
  std::rewind(kept.get());
  if (::lseek(::fileno(kept.get()), 0, SEEK_SET) != 0 || ::dup2(::fileno(kept.get()), STDIN_FILENO) < 0) {
    return systemError(ErrorCode::device, input.name(), "cannot be kept", errno);
  }
  return hash.contents();
}

/// Error (input): an input has changed.
Result<void> checkInputs(const RerunCommand& command, const RecordedRun& run) {
  std::vector<std::string> changed;
  for (const LoggedFile& file : run.inputs) {
    VORPIPE_LET(now, file.path == "-" ? keepStandardInput() : contentsOf(file.path));
    if (now == file.contents) continue;
    changed.push_back(fmt::format(
        "{}: has changed since the run that {} tells of: {} bytes, hash {}, not {} bytes, hash {}",
        file.path == "-" ? "<stdin>" : file.path, command.stats, now.bytes, now.xxh128, file.contents.bytes,
        file.contents.xxh128));
  }
  if (changed.empty()) return {};
  return inputError(fmt::to_string(fmt::join(changed, "; ")));
}

/// Runs the arguments as main does; `stats` receives the run's --stats text, if the run gets that far.
Result<ExitCode> runAgain(CommandLine& line, const std::vector<std::string>& arguments, std::string& stats) {
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), "vorpipe");
  std::vector<char*> pointers;
  pointers.reserve(words.size());
  for (std::string& word : words) pointers.push_back(word.data());
  const auto run = line.parse(static_cast<int>(pointers.size()), pointers.data());
  // The error is already on standard error.
  if (!run) return static_cast<ExitCode>(run.error());
  return (*run)({arguments, &stats});
}

void noteChanges(const RerunCommand& command, const RecordedRun& then, const RecordedRun& now) {
  if (command.talk.quiet) return;
  const auto note = [](std::string_view what, const std::string& before, const std::string& after) {
    const auto orUnknown = [](const std::string& text) { return text.empty() ? "unknown" : text; };
    if (before != after) {
      printNote(fmt::format("another {}: {} then, {} now", what, orUnknown(before), orUnknown(after)));
    }
  };
  note("version", then.version, now.version);
  note("revision", then.revision, now.revision);
  note("backend", then.backend, now.backend);
  note("device", then.device, now.device);
}

/// Returns the differences, one text per file.
std::vector<std::string> differences(const RecordedRun& then, const RecordedRun& now) {
  std::vector<std::string> parts;
  const std::size_t both = std::min(then.outputs.size(), now.outputs.size());
  for (std::size_t i = 0; i < both; ++i) {
    const WrittenFile &was = then.outputs[i], &is = now.outputs[i];
    const Contents &before = was.file.contents, &after = is.file.contents;
    const bool same = was.timeless.empty() ? before == after : was.timeless == is.timeless;
    if (same) continue;
    parts.push_back(fmt::format("{}: other bytes: {} then, hash {}, {} now, hash {}", was.file.path,
                                before.bytes, before.xxh128, after.bytes, after.xxh128));
  }
  for (std::size_t i = both; i < then.outputs.size(); ++i)
    parts.push_back(then.outputs[i].file.path + ": was not written again");
  for (std::size_t i = both; i < now.outputs.size(); ++i)
    parts.push_back(now.outputs[i].file.path + ": was not written then");
  return parts;
}

/// JSON cannot hold bytes that are not UTF-8: reports replace each by a character, so such a name is lost.
Result<void> checkNames(const RerunCommand& command, const std::vector<std::string>& arguments) {
  constexpr std::string_view replaced = "\xEF\xBF\xBD";
  const auto lost = [&](const std::string& argument) { return argument.find(replaced) != std::string::npos; };
  const auto found = std::ranges::find_if(arguments, lost);
  if (found == arguments.end()) return {};
  return inputError(fmt::format("{}: the report cannot tell the name {}, which was not UTF-8: run it by hand",
                                command.stats, *found));
}

Result<ExitCode> rerun(const RerunCommand& command, CommandLine& line) {
  VORPIPE_LET(then, readRecordedRun(command.stats));
  VORPIPE_LET(arguments, argumentsAgain(command, line.declared(), then));
  VORPIPE_TRY(checkNames(command, arguments));
  if (command.dry_run) {
    fmt::print("vorpipe {}\n", shellLine(arguments));
    return exit_done;
  }
  VORPIPE_TRY(checkInputs(command, then));
  std::string stats;
  auto code = runAgain(line, arguments, stats);
  if (!code || stats.empty()) return code;
  VORPIPE_LET(now, recordedRun("the run", stats));
  noteChanges(command, then, now);
  const auto parts = differences(then, now);
  if (!parts.empty()) {
    printError(fmt::to_string(fmt::join(parts, "; ")));
    return exit_different;
  }
  std::vector<std::string> paths;
  std::vector<std::string> named;
  for (const WrittenFile& written : then.outputs) {
    paths.push_back(written.file.path);
    named.push_back(paths.back() + (written.timeless.empty() ? "" : " (but for times)"));
  }
  printSummary(
      command.talk, paths,
      paths.empty() ? "no files to compare\n" : fmt::format("same bytes: {}\n", fmt::join(named, ", ")));
  return exit_done;
}

}  // namespace

void addRerun(CommandLine& line) {
  auto command = std::make_shared<RerunCommand>();
  Options options = line.addSubcommand(
      "rerun", "does again what a file of --stats tells of, and says whether it comes to the same bytes",
      [command, &line](const Invocation&) { return rerun(*command, line); });
  options.addText("STATS", command->stats, "FILE", "what --stats wrote, in JSON", {{}, {".json"}}).required();
  options.addFlag("--dry-run", command->dry_run,
                  "prints the command line, without --stats, for a shell; runs nothing");
  addTalkOptions(options, command->talk);
}

}  // namespace vorpipe::cli
