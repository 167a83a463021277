#include "io/base/number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include "io/base/quoted.h"

namespace vorpipe {
namespace {

/// Whether a number beyond the range of double is too small rather than too large.
bool isTiny(std::string_view number) {
  const std::size_t mark = number.find_first_of("eE");
  const std::string_view digits = number.substr(0, mark);
  const std::size_t leading = digits.find_first_of("123456789");
  const std::size_t point = std::min(digits.find('.'), digits.size());
  // In a number near the limits the first digit lies within the text, so an exponent beyond long decides
  // alone.
  long exponent = 0;
  if (mark != std::string_view::npos) {
    std::string_view text = number.substr(mark + 1);
    const bool negative = text.starts_with('-');
    text.remove_prefix(text.starts_with('+') ? 1 : 0);
    if (std::from_chars(text.data(), text.data() + text.size(), exponent).ec != std::errc()) return negative;
  }
  // Far beyond the digits of any text, but small enough that sums do not overflow.
  constexpr long farthest = 1L << 48;
  exponent = std::clamp(exponent, -farthest, farthest);
  return exponent + static_cast<long>(point) - static_cast<long>(leading) < 0;
}

/// Parses `number`, which is `text` in its file.
tl::expected<double, std::string> numberIn(std::string_view number, std::string_view text) {
  number = trimmed(number);
  if (number.empty()) return tl::unexpected(std::string("empty field"));
  if (number.size() > 1 && number[0] == '+' && number[1] != '-') number.remove_prefix(1);
  double value = 0;
  const char* const last = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), last, value);
  if (stop != last || error == std::errc::invalid_argument) {
    return tl::unexpected(inQuotes(text) + " is not a number");
  }
  if (error == std::errc::result_out_of_range) {
    if (!isTiny(number)) return tl::unexpected(inQuotes(text) + " is out of the range of a double");
    return number[0] == '-' ? -0.0 : 0.0;
  }
  if (!std::isfinite(value)) return tl::unexpected(inQuotes(text) + " is not a finite number");
  return value;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::string upperCase(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return upper;
}

bool isMissingValue(std::string_view text) {
  constexpr std::array<std::string_view, 9> spellings{"",     "NA",   "N/A", "nan", "NaN",
                                                      "NULL", "None", "-",   "."};
  text = trimmed(text);
  // Nearly all fields are numbers.
  if (text.size() > 4 || (!text.empty() && text[0] >= '0' && text[0] <= '9')) return false;
  return std::ranges::find(spellings, text) != spellings.end();
}

tl::expected<double, std::string> parseNumber(std::string_view text) { return numberIn(text, text); }

tl::expected<Decimal, std::string> parseDecimal(std::string_view text) {
  const auto commas = std::ranges::count(text, ',');
  const bool point = text.find('.') != std::string_view::npos;
  if (commas == 0) {
    return parseNumber(text).map([point](double value) {
      return Decimal{value, point ? DecimalMark::point : DecimalMark::none};
    });
  }
  if (point)
    return tl::unexpected(inQuotes(text) + " has a comma and a point: only one can be before a fraction");
  if (commas > 1) return tl::unexpected(inQuotes(text) + " has several commas");
  std::string with_point(text);
  std::ranges::replace(with_point, ',', '.');
  return numberIn(with_point, text).map([](double value) { return Decimal{value, DecimalMark::comma}; });
}

}  // namespace vorpipe
