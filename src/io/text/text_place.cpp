#include "io/text/text_place.h"

#include <fmt/core.h>

#include <algorithm>

namespace vorpipe {

std::string placeOf(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte);
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  return fmt::format("{}:{}", 1 + std::ranges::count(before, '\n'), byte - line_begin + 1);
}

}  // namespace vorpipe
