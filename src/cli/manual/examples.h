/// Adds the examples of the man pages to --help.
#pragma once

#include "cli/options/command_line.h"

namespace vorpipe::cli {

/// Adds each subcommand's examples to the end of its help, and the first one to the program's help.
void addExamples(CommandLine& line);

}  // namespace vorpipe::cli
