#include "cli/manual/completions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorpipe::cli {

std::string shellQuoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string spaced(const std::vector<std::string>& words) { return fmt::to_string(fmt::join(words, " ")); }

}  // namespace vorpipe::cli
