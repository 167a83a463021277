/// Prints errors and notes.
#pragma once

#include <string_view>

namespace vorpipe::cli {

/// Prints one line `vorpipe: MESSAGE` on standard error; escapes what does not fit into one line.
void printError(std::string_view message);

/// Prints that there is not enough memory, without allocating any.
void printOutOfMemory();

/// Prints `vorpipe: note: TEXT` likewise.
void printNote(std::string_view text);

}  // namespace vorpipe::cli
