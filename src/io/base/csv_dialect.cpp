#include "io/base/csv_dialect.h"

#include <algorithm>
#include <cstddef>

#include "io/base/number.h"

namespace vorpipe {
namespace {

constexpr std::string_view separators = ",;\t";

/// Returns how often a character occurs outside quotes.
std::size_t countOf(std::string_view line, char separator) {
  bool quoted = false;
  std::size_t count = 0;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == separator && !quoted) ++count;
  }
  return count;
}

/// Whether it separates two or more numbers.
bool separatesNumbers(std::string_view line, char separator) {
  std::size_t count = 0;
  while (true) {
    const std::size_t end = std::min(line.find(separator), line.size());
    const std::string_view field = line.substr(0, end);
    const bool number = separator == ',' ? parseNumber(field).has_value() : parseDecimal(field).has_value();
    if (!number) return false;
    ++count;
    if (end == line.size()) return count > 1;
    line.remove_prefix(end + 1);
  }
}

}  // namespace

char separatorOf(std::string_view line) {
  // In "1,5;2,5" counting does not help: it has as many commas as fields.
  for (const char separator : {';', '\t'}) {
    if (separatesNumbers(line, separator)) return separator;
  }
  return *std::ranges::max_element(separators, {}, [line](char c) { return countOf(line, c); });
}

std::optional<char> namedSeparator(std::string_view line) {
  constexpr std::string_view name = "sep=";
  // A tab at the end may be the separator; spreadsheets quote the whole line.
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  while (line.size() > name.size() + 1 && (line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
  if (line.size() == name.size() + 3 && line.front() == '"' && line.back() == '"')
    line = line.substr(1, name.size() + 1);
  const bool named = line.size() == name.size() + 1 &&
                     std::ranges::equal(line.substr(0, name.size()), name, [](char a, char b) {
                       return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b;
                     });
  if (!named || separators.find(line.back()) == std::string_view::npos) return std::nullopt;
  return line.back();
}

}  // namespace vorpipe
