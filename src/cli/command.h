/// What the subcommands have in common with main.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe::cli {

enum ExitCode : int { exit_done = 0, exit_different = 1, exit_input = 2, exit_device = 3 };

/// A subcommand's options, and what runs it once they are parsed: the exit code, or an error that
/// main prints and turns into one.
struct Subcommand {
  CLI::App* app;
  std::function<Result<ExitCode>()> run;
};

Subcommand addRender(CLI::App& app);
Subcommand addCells(CLI::App& app);
Subcommand addDiff(CLI::App& app);
Subcommand addCompare(CLI::App& app);
Subcommand addDevices(CLI::App& app);
Subcommand addBench(CLI::App& app);
Subcommand addSelftest(CLI::App& app);

/// Prints one line `vorpipe: MESSAGE` on standard error; what is not fit for one line is replaced.
void printError(std::string_view message);

}  // namespace vorpipe::cli
