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
  fmt::print(stderr, "vorpipe: {}\n", line);
}

void printNote(std::string_view text) { printError(fmt::format("note: {}", text)); }

}  // namespace vorpipe::cli
