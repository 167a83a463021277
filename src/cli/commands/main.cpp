#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

#include "cli/commands/command.h"
#include "cli/kept_memory.h"
#include "cli/manual/manual.h"
#include "cli/options/error_line.h"
#include "cli/options/options.h"
#include "cli/progress.h"
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

/// Returns the exit code, after checking that all output reached standard output.
int afterOutput(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  printError("standard output: writing failed");
  return exit_device;
}

int runSubcommand(const Run& run, const Invocation& how) {
  const auto validation = validationAskedByEnvironment();
  const auto done = validation ? run(how) : tl::unexpected(validation.error());
  ignoreSignals();
  if (!done) {
    printError(done.error().code == ErrorCode::cancelled ? "interrupted" : done.error().message);
    return exitCode(done.error());
  }
  return afterOutput(*done);
}

int parseAndRun(int count, char** arguments) {
  CommandLine line(
      "vorpipe",
      "Voronoi diagrams (Thiessen polygons, Dirichlet cells) and power diagrams (Laguerre, radical) of "
      "sites in the plane, on any GPU or without one",
      fmt::format("vorpipe {}", version()));
  for (const auto add : {addRender, addCells, addRelax, addTransport, addFluid, addView, addDiff, addCompare,
                         addRerun, addDevices, addBench, addSelftest})
    add(line);
  addExamples(line);
  const Invocation how{{arguments + std::min(count, 1), arguments + count}};
  if (const auto manual = manualAsked(line, {arguments, static_cast<std::size_t>(count)})) {
    const auto print = [&](const Invocation&) -> Result<ExitCode> {
      if (!*manual) return tl::unexpected(manual->error());
      fmt::print("{}", **manual);
      return exit_done;
    };
    return runSubcommand(print, how);
  }
  const auto run = line.parse(count, arguments);
  return run ? runSubcommand(*run, how) : afterOutput(run.error());
}

}  // namespace
}  // namespace vorpipe::cli

int main(int count, char** arguments) {
  using namespace vorpipe::cli;
  vorpipe::keepFreedMemory();
  try {
    openStandardStreams();
    endOnSignals();
    endOnUncaught(exit_device);
    endOnLostPages(exit_input);
    return parseAndRun(count, arguments);
  } catch (const std::bad_alloc&) {
    printOutOfMemory();
  } catch (const std::exception& error) {
    printUncaught(error);
  }
  return exit_device;
}
