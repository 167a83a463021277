/// Fields of a table as attributes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/base/attribute.h"
#include "io/base/csv_reader.h"
#include "io/base/number.h"

namespace vorpipe {

/// Text of fields as UTF-8.
class CsvText {
 public:
  /// Returns a field of the last record; valid until the next call.
  std::string_view of(const CsvReader& csv, std::size_t field);

  /// The first line with a field that was not UTF-8; 0 if there is none.
  [[nodiscard]] std::uint64_t otherLine() const { return other_line_; }

 private:
  std::string text_;
  std::uint64_t other_line_ = 0;
};

/// Converts numbers with decimal commas to JSON numbers if all values are numbers. `mark` is the decimal mark
/// of the file's coordinates. If they have none, an attribute of only values like 1,234 stays text: commas
/// may mark thousands.
Attribute withDecimalPoints(Attribute attribute, DecimalMark mark);

}  // namespace vorpipe
