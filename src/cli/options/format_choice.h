/// The formats of standard input and output, which have no file names to show them.
#pragma once

#include <string>
#include <string_view>

#include "cli/options/parse.h"

namespace vorpipe::cli {

/// Extensions without the dot; empty if not given.
struct FormatChoice {
  std::string input, output;
};

/// Parses `KIND`, for both, or `IN,OUT`; any case. Whether a kind exists is checked by its reader or writer.
Parsed<FormatChoice> parseFormat(std::string_view text);

}  // namespace vorpipe::cli
