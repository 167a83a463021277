/// Words and whole numbers in texts.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace vorpipe {

/// `text` with ASCII letters in lower case.
inline std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

/// Whether `part` is a part of `whole`, in any case.
inline bool isPartOf(std::string_view part, std::string_view whole) {
  return lowerCase(whole).find(lowerCase(part)) != std::string::npos;
}

/// Reads a whole text as an integer in decimal digits; none if it is another text, or no such Number.
template <class Number>
std::optional<Number> wholeNumber(std::string_view text) {
  Number value{};
  const char* const last = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), last, value);
  return stop == last && error == std::errc() ? std::optional(value) : std::nullopt;
}

/// Whether `wanted` means the thing with that index and name in a list: digits are an index, and nothing
/// else; another text is a part of the name.
inline bool isIndexOrPartOf(std::string_view wanted, std::size_t index, std::string_view name) {
  const bool digits =
      !wanted.empty() && std::ranges::all_of(wanted, [](char c) { return c >= '0' && c <= '9'; });
  return digits ? wholeNumber<std::size_t>(wanted) == index : isPartOf(wanted, name);
}

}  // namespace vorpipe
