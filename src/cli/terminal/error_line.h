/// How errors are told.
#pragma once

#include <string_view>

namespace vorpipe::cli {

/// Prints one line `vorpipe: MESSAGE` on standard error; what is not fit for one line is replaced.
void printError(std::string_view message);

}  // namespace vorpipe::cli
