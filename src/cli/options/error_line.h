/// How errors and notes are told.
#pragma once

#include <string_view>

namespace vorpipe::cli {

/// Prints one line `vorpipe: MESSAGE` on standard error; what is not fit for one line is replaced.
void printError(std::string_view message);

/// Prints that there is not enough memory, without taking any.
void printOutOfMemory();

/// Prints `vorpipe: note: TEXT` likewise.
void printNote(std::string_view text);

}  // namespace vorpipe::cli
