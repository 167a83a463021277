/// The examples of the man pages in --help.
#pragma once

#include "cli/options/command_line.h"

namespace vorpipe::cli {

/// Puts its examples below the help of each subcommand, and the first below that of the program.
void addExamples(CommandLine& line);

}  // namespace vorpipe::cli
