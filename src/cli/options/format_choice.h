/// The kinds of what comes by standard input and goes to standard output, which have no names to tell.
#pragma once

#include <string>
#include <string_view>

#include "cli/options/parse.h"

namespace vorpipe::cli {

/// Extensions without the dot; empty where none is named.
struct FormatChoice {
  std::string input, output;
};

/// `KIND`, which is for both, or `IN,OUT`; any case. Whether a kind is known is for who reads or writes it.
Parsed<FormatChoice> parseFormat(std::string_view text);

}  // namespace vorpipe::cli
