#include "cli/options/format_choice.h"

#include <fmt/core.h>

#include <algorithm>

#include "io/base/quoted.h"

namespace vorpipe::cli {
namespace {

bool isKind(std::string_view text) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789.";
  return !text.empty() && text.front() != '.' && text.find_first_not_of(letters) == std::string_view::npos;
}

}  // namespace

Parsed<FormatChoice> parseFormat(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const std::size_t comma = std::min(lower.find(','), lower.size());
  FormatChoice choice{lower.substr(0, comma), comma < lower.size() ? lower.substr(comma + 1) : lower};
  if (isKind(choice.input) && isKind(choice.output)) return choice;
  return tl::unexpected(
      fmt::format("{} is no kind of file, as in csv, or two, as in csv,geojson", vorpipe::inQuotes(text)));
}

}  // namespace vorpipe::cli
