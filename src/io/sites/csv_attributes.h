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
  /// That of a field of the last record; valid until the next call.
  std::string_view of(const CsvReader& csv, std::size_t field);

  /// The first line with a field that was not UTF-8; 0: there is none.
  [[nodiscard]] std::uint64_t otherLine() const { return other_line_; }

 private:
  std::string text_;
  std::uint64_t other_line_ = 0;
};

/// Numbers with decimal commas as JSON has them, where all values are numbers. `mark` is what the file's
/// coordinates have before their fractions; where they have none, values such as 1,234 alone stay text: that
/// may be a thousand.
Attribute withDecimalPoints(Attribute attribute, DecimalMark mark);

}  // namespace vorpipe
