#include <fmt/core.h>

#include <cstdio>
#include <exception>
#include <new>

#include "cli/commands/command.h"
#include "cli/kept_memory.h"
#include "cli/terminal/error_line.h"
#include "cli/terminal/progress.h"
#include "vorpipe.h"

namespace vorpipe::cli {

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

int runSubcommand(const Run& run) {
  const auto done = run();
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

int parseAndRun(int count, char** arguments) {
  CommandLine line("vorpipe", "Voronoi diagrams of sites in the plane, on any GPU or without one");
  for (const auto add : {addRender, addCells, addDiff, addCompare, addDevices, addBench, addSelftest})
    add(line);
  const auto run = line.parse(count, arguments, fmt::format("vorpipe {}", version()));
  return run ? runSubcommand(*run) : run.error();
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
