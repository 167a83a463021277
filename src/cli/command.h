/// The subcommands.
#pragma once

#include <string_view>

#include "cli/command_line.h"

namespace vorpipe::cli {

void addRender(CommandLine& line);
void addCells(CommandLine& line);
void addDiff(CommandLine& line);
void addCompare(CommandLine& line);
void addDevices(CommandLine& line);
void addBench(CommandLine& line);
void addSelftest(CommandLine& line);

/// Prints one line `vorpipe: MESSAGE` on standard error; what is not fit for one line is replaced.
void printError(std::string_view message);

}  // namespace vorpipe::cli
