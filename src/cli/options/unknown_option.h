/// Finds the first unknown option on a command line.
#pragma once

#include <span>
#include <string>

#include "cli/options/declared.h"

namespace vorpipe::cli {

/// What is wrong with the first of the arguments behind a subcommand that is none of its options; empty where
/// all are, or help or the version is asked for before.
std::string unknownOption(const DeclaredSubcommand& subcommand, std::span<char* const> arguments);

}  // namespace vorpipe::cli
