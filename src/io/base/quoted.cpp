#include "io/base/quoted.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace vorpipe {
namespace {

constexpr std::uint32_t first_of_two = 0x80, first_of_three = 0x800, first_of_four = 0x10000;

/// Characters of Windows-1252 for 0x80 to 0x9F; the five undefined ones are as in Latin-1.
constexpr std::array<std::uint32_t, 32> windows_1252 = {
    0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};

/// Returns the length of the character that this byte begins; 0 if it begins none.
std::size_t lengthFrom(unsigned char byte) {
  if (byte < 0x80) return 1;
  if (byte >= 0xC2 && byte <= 0xDF) return 2;
  if (byte >= 0xE0 && byte <= 0xEF) return 3;
  return byte >= 0xF0 && byte <= 0xF4 ? 4 : 0;
}

bool isCharacter(std::string_view bytes) {
  std::uint32_t code = static_cast<unsigned char>(bytes[0]) & (0xFFu >> (bytes.size() + 1));
  for (const char c : bytes.substr(1)) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0) != 0x80) return false;
    code = code << 6 | (byte & 0x3Fu);
  }
  if (bytes.size() == 3) return code >= first_of_three && (code < 0xD800 || code > 0xDFFF);
  return bytes.size() != 4 || (code >= first_of_four && code <= 0x10FFFF);
}

/// Appends a code below first_of_four.
void append(std::string& text, std::uint32_t code) {
  if (code < first_of_two) {
    text += static_cast<char>(code);
  } else if (code < first_of_three) {
    text += static_cast<char>(0xC0 | code >> 6);
    text += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    text += static_cast<char>(0xE0 | code >> 12);
    text += static_cast<char>(0x80 | (code >> 6 & 0x3F));
    text += static_cast<char>(0x80 | (code & 0x3F));
  }
}

constexpr std::size_t longest = 40;

/// Returns the length of the UTF-8 character at the start of `bytes`; 0 if there is none. Surrogates and
/// overlong forms are no characters.
std::size_t characterLength(std::string_view bytes) {
  const std::size_t length = bytes.empty() ? 0 : lengthFrom(static_cast<unsigned char>(bytes[0]));
  if (length > bytes.size()) return 0;
  return length < 2 || isCharacter(bytes.substr(0, length)) ? length : 0;
}

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

/// Whether a terminal takes a part of it for a command: ASCII controls, and those whose UTF-8 begins with C2.
bool hasControls(std::string_view text) {
  constexpr unsigned char blank = 0x20, rub_out = 0x7F, leads = 0xC2, last = 0xA0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    const auto next = static_cast<unsigned char>(k + 1 < text.size() ? text[k + 1] : last);
    if (byte < blank || byte == rub_out || (byte == leads && next < last)) return true;
  }
  return false;
}

/// Quotes as $'...', with only bytes of plain text.
std::string inOctal(std::string_view text) {
  std::string quoted = "$'";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= 0x20 && byte < 0x7F && c != '\'' && c != '\\';
    quoted += plain ? std::string(1, c) : fmt::format("\\{:03o}", byte);
  }
  return quoted + "'";
}

}  // namespace

bool isUtf8(std::string_view bytes) {
  const auto first =
      std::ranges::find_if(bytes, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  bytes.remove_prefix(static_cast<std::size_t>(first - bytes.begin()));
  while (!bytes.empty()) {
    const std::size_t length = characterLength(bytes);
    if (length == 0) return false;
    bytes.remove_prefix(length);
  }
  return true;
}

std::string fromWindows1252(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    append(text, byte >= 0x80 && byte < 0xA0 ? windows_1252[byte - 0x80u] : byte);
  }
  return text;
}

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

std::string shellQuoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shellLine(const std::vector<std::string>& words) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+=:,./-";
  std::string line;
  for (const std::string& word : words) {
    const bool is_plain = !word.empty() && word.find_first_not_of(plain) == std::string::npos;
    line += line.empty() ? "" : " ";
    line += is_plain ? word : hasControls(word) ? inOctal(word) : shellQuoted(word);
  }
  return line;
}

}  // namespace vorpipe
