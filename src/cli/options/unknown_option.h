/// Finds the first unknown option on a command line.
#pragma once

#include <span>
#include <string>

#include "cli/options/declared.h"

namespace vorpipe::cli {

/// Returns an error text for the first argument after a subcommand that is not one of its options. Empty if
/// there is none, or if help or the version is requested before it.
std::string unknownOption(const DeclaredSubcommand& subcommand, std::span<char* const> arguments);

}  // namespace vorpipe::cli
