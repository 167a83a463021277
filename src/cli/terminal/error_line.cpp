#include "cli/terminal/error_line.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace vorpipe::cli {

void printError(std::string_view message) {
  std::string line(message);
  std::ranges::replace_if(
      line, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  // What standard error does not take is lost: fmt::print would throw.
  std::fputs(fmt::format("vorpipe: {}\n", line).c_str(), stderr);
}

void printOutOfMemory() { std::fputs("vorpipe: there is not enough memory for this\n", stderr); }

void printNote(std::string_view text) { printError(fmt::format("note: {}", text)); }

}  // namespace vorpipe::cli
