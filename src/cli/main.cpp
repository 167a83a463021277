#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <new>

#include "cli/command.h"
#include "cli/kept_memory.h"
#include "cli/progress.h"
#include "io/error.h"
#include "vorpipe.h"

namespace vorpipe::cli {

void printError(std::string_view message) {
  std::string line(message);
  std::ranges::replace_if(
      line, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  fmt::print(stderr, "vorpipe: {}\n", line);
}

namespace {

int exitCode(const Error& error) {
  switch (error.code) {
    case ErrorCode::input:
      return exit_input;
    case ErrorCode::device:
      return exit_device;
    case ErrorCode::cancelled:
      return signalExitCode();
  }
  return exit_device;
}

int runSubcommand(std::span<const Subcommand> subcommands) {
  const auto chosen =
      std::ranges::find_if(subcommands, [](const Subcommand& sub) { return sub.app->parsed(); });
  const auto done = chosen->run();
  ignoreSignals();
  if (!done) {
    printError(done.error().code == ErrorCode::cancelled ? "interrupted" : done.error().message);
    return exitCode(done.error());
  }
  if (std::fflush(stdout) != 0) {
    printError("standard output: writing failed");
    return exit_device;
  }
  return *done;
}

/// What CLI11 would only call a missing subcommand.
bool namesNoSubcommand(std::span<const Subcommand> subcommands, std::string_view argument) {
  return !argument.starts_with('-') && std::ranges::none_of(subcommands, [&](const Subcommand& sub) {
    return sub.app->get_name() == argument;
  });
}

int parseAndRun(int count, char** arguments) {
  CLI::App app("Voronoi diagrams of sites in the plane, on any GPU or without one", "vorpipe");
  app.require_subcommand(1);
  const std::array subcommands = {addRender(app),  addCells(app), addDiff(app),    addCompare(app),
                                  addDevices(app), addBench(app), addSelftest(app)};
  const std::string version_line = fmt::format("vorpipe {}", version());
  app.set_version_flag("--version", version_line);
  for (const Subcommand& sub : subcommands) sub.app->set_version_flag("--version", version_line);
  if (count > 1 && namesNoSubcommand(subcommands, arguments[1])) {
    printError(fmt::format("{} is no subcommand; see vorpipe --help", quoted(arguments[1])));
    return exit_input;
  }
  try {
    app.parse(count, arguments);
  } catch (const CLI::Success& asked) {
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    printError(fmt::format("{}; see vorpipe --help", error.what()));
    return exit_input;
  }
  return runSubcommand(subcommands);
}

}  // namespace
}  // namespace vorpipe::cli

int main(int count, char** arguments) {
  using namespace vorpipe::cli;
  vorpipe::keepFreedMemory();
  try {
    endOnSignals();
    return parseAndRun(count, arguments);
  } catch (const std::bad_alloc&) {
    printError("there is not enough memory for this");
  } catch (const std::exception& error) {
    printError(error.what());
  }
  return exit_device;
}
