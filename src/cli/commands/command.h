/// The subcommands.
#pragma once

#include "cli/options/command_line.h"

namespace vorpipe::cli {

void addRender(CommandLine& line);
void addCells(CommandLine& line);
void addRelax(CommandLine& line);
void addFluid(CommandLine& line);
void addTransport(CommandLine& line);
void addDiff(CommandLine& line);
void addCompare(CommandLine& line);
/// `line` must stay in place: the run parses with it again.
void addRerun(CommandLine& line);
void addDevices(CommandLine& line);
void addBench(CommandLine& line);
void addSelftest(CommandLine& line);
void addView(CommandLine& line);

}  // namespace vorpipe::cli
