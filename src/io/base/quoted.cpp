#include "io/base/quoted.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>

#include "io/base/utf8.h"

namespace vorpipe {
namespace {

constexpr std::size_t longest = 40;

/// Whether the bytes of a character, or a byte that begins none, are shown unchanged.
bool isShown(std::string_view character) {
  const auto isBetween = [character](std::string_view first, std::string_view last) {
    return character >= first && character <= last;
  };
  if (character.size() == 1) return isBetween(" ", "~");
  // Controls of ISO 6429 beyond ASCII; line and paragraph separators and marks of writing direction;
  // direction isolates.
  return !isBetween("\u0080", "\u009f") && !isBetween("\u2028", "\u202e") && !isBetween("\u2066", "\u2069");
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const std::string_view character = text.substr(0, std::max<std::size_t>(characterLength(text), 1));
    if (isShown(character)) {
      line += character;
    } else {
      for (const char c : character) line += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
    text.remove_prefix(character.size());
  }
  return line;
}

std::string printable(std::string_view text) {
  if (text.size() <= longest) return escaped(text);
  std::size_t cut = 0;
  for (std::size_t end = 0; end <= longest;
       end += std::max<std::size_t>(characterLength(text.substr(end)), 1))
    cut = end;
  return escaped(text.substr(0, cut)) + "...";
}

std::string inQuotes(std::string_view text) { return fmt::format("\"{}\"", printable(text)); }

}  // namespace vorpipe
