#include "cli/options/error_line.h"

#include <fmt/core.h>

#include <cstdio>

#include "io/base/quoted.h"

namespace vorpipe::cli {

void printError(std::string_view message) {
  // Failed writes to standard error are ignored: fmt::print would throw.
  std::fputs(fmt::format("vorpipe: {}\n", escaped(message)).c_str(), stderr);
}

void printOutOfMemory() { std::fputs("vorpipe: there is not enough memory for this\n", stderr); }

void printNote(std::string_view text) { printError(fmt::format("note: {}", text)); }

}  // namespace vorpipe::cli
