#include "io/base/shell_line.h"

#include <fmt/format.h>

namespace vorpipe {
namespace {

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

std::string shellWord(const std::string& word) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+=:,./-";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  return hasControls(word) ? inOctal(word) : shellQuoted(word);
}

}  // namespace

std::string shellQuoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shellLine(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shellWord(word);
  return line;
}

}  // namespace vorpipe
