/// Man pages and the completions of shells, made of what was declared of the command line, so that they never
/// name an option that is not there (decision D93).
#pragma once

#include <optional>
#include <span>
#include <string>

#include "cli/options/command_line.h"

namespace vorpipe::cli {

/// What a command line asks for that begins with one of the two options that help does not list:
/// `--help-man [SUBCOMMAND]`, a page in roff, or `--completions SHELL`, a script. Nothing where it begins
/// with neither. Errors (input): there is no such subcommand or shell, or there is more.
std::optional<Result<std::string>> manualAsked(const CommandLine& line, std::span<char* const> arguments);

}  // namespace vorpipe::cli
