#include "io/sites/csv_attributes.h"

#include <algorithm>

#include "io/base/utf8.h"

namespace vorpipe {
namespace {

std::string withPoint(std::string_view text) {
  std::string number(text);
  std::ranges::replace(number, ',', '.');
  return number;
}

/// Whether the comma may be a thousands separator: three digits follow.
bool mayBeThousands(std::string_view text) {
  constexpr std::size_t digits = 3;
  return text.size() - text.find(',') - 1 == digits;
}

/// Whether all values are numbers, some with a comma and none with a point.
bool haveDecimalCommas(const Attribute& attribute, DecimalMark mark) {
  bool any = false, thousands = true;
  for (std::size_t site = 0; site < attribute.size(); ++site) {
    const auto value = attribute.at(site);
    if (!value) continue;
    const auto commas = std::ranges::count(*value, ',');
    if (commas > 1 || value->find('.') != std::string_view::npos || !isJsonNumber(withPoint(*value)))
      return false;
    any = any || commas == 1;
    thousands = thousands && (commas == 0 || mayBeThousands(*value));
  }
  return any && (mark == DecimalMark::comma || !thousands);
}

}  // namespace

std::string_view CsvText::of(const CsvReader& csv, std::size_t field) {
  const std::string_view bytes = csv.field(field);
  if (isUtf8(bytes)) return bytes;
  if (other_line_ == 0) other_line_ = csv.line();
  text_ = fromWindows1252(bytes);
  return text_;
}

Attribute withDecimalPoints(Attribute attribute, DecimalMark mark) {
  if (mark == DecimalMark::point || !haveDecimalCommas(attribute, mark)) return attribute;
  return attribute.rewritten(attribute.type(), withPoint);
}

}  // namespace vorpipe
