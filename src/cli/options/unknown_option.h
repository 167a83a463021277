/// Finds the first unknown option on a command line, and suggests known words.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "cli/options/declared.h"

namespace vorpipe::cli {

/// Returns an error text for the first argument after a subcommand that is not one of its options. Empty if
/// there is none, or if help or the version is requested before it.
std::string unknownOption(const DeclaredSubcommand& subcommand, std::span<char* const> arguments);

/// "; did you mean WORD?", with the word of `known` most likely meant by `typed`; nothing if there is none.
std::string didYouMean(std::string_view typed, std::span<const std::string> known);

}  // namespace vorpipe::cli
