/// Man pages and shell completions, generated from the declared command line so that they never name an
/// option that does not exist (decision D93).
#pragma once

#include <optional>
#include <span>
#include <string>

#include "cli/options/command_line.h"

namespace vorpipe::cli {

/// Handles a command line that begins with one of two options that help does not list. `--help-man
/// [SUBCOMMAND]` returns a page in roff, `--completions SHELL` a script. Returns nothing if it begins with
/// neither. Errors (input): no such subcommand or shell, or further arguments.
std::optional<Result<std::string>> manualAsked(const CommandLine& line, std::span<char* const> arguments);

/// Adds each subcommand's examples to the end of its help, and the first one to the program's help.
void addExamples(CommandLine& line);

}  // namespace vorpipe::cli
