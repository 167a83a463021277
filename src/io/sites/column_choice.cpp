#include "io/sites/column_choice.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include "io/base/error.h"
#include "io/base/quoted.h"

namespace vorpipe {

std::optional<std::size_t> columnNumber(std::string_view text) {
  std::size_t number = 0;
  const char* const last = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), last, number);
  if (text.empty() || stop != last || error != std::errc()) return std::nullopt;
  return number;
}

Result<std::vector<std::size_t>> numberedColumns(std::span<const std::string> columns, std::size_t count,
                                                 std::string_view name) {
  std::vector<std::size_t> chosen;
  for (const std::string& column : columns) {
    const auto number = columnNumber(column);
    if (!number) {
      return inputError(fmt::format("{}: its columns have no names, as {}; they have numbers from 1", name,
                                    inQuotes(column)));
    }
    if (*number < 1 || *number > count) {
      return inputError(fmt::format("{}: has no column {}; it has {}", name, column, count));
    }
    if (std::ranges::find(chosen, *number - 1) != chosen.end()) {
      return inputError(fmt::format("{}: column {} is named twice", name, column));
    }
    chosen.push_back(*number - 1);
  }
  if (chosen.size() == 2 || chosen.size() == 3) return chosen;
  return inputError(fmt::format("{}: two or three columns are needed, as in 1,2 or 1,2,3", name));
}

}  // namespace vorpipe
