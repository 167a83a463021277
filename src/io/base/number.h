/// Words and numbers as people and programs write them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/words.h"
#include "vorpipe.h"

namespace vorpipe {

/// `text` without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// `text` with ASCII letters in upper case.
std::string upperCase(std::string_view text);

/// Whether a field marks a missing value, as people, R and NumPy write it: it is empty, NA, N/A, nan, NaN,
/// NULL, None, a minus or a point.
bool isMissingValue(std::string_view text);

/// Reads a finite decimal number, blanks around it and a leading + allowed, to the nearest double; one too
/// small for a double becomes 0. The error states what is wrong with the text, in words that continue
/// "FILE:LINE:COLUMN: ".
tl::expected<double, std::string> parseNumber(std::string_view text);

/// Mark before the fraction of a number.
enum class DecimalMark : char { none = ' ', point = '.', comma = ',' };

struct Decimal {
  double value;
  DecimalMark mark;
};

/// The same, but allows a comma before the fraction, as in 1,5. Refuses possible thousands separators:
/// several commas, or a comma and a point.
tl::expected<Decimal, std::string> parseDecimal(std::string_view text);

}  // namespace vorpipe
