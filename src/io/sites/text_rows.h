/// Rows of a text whose fields are separated by blanks or commas, as sites of a table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/base/line_reader.h"
#include "io/sites/site_columns.h"
#include "io/sites/sites_reader.h"
#include "io/sites/table_builder.h"

namespace vorpipe {

class TextRows {
 public:
  TextRows(InputFile file, const ReadOptions& options)
      : lines_(std::move(file)), options_(options), table_(lines_.name(), options) {}

  [[nodiscard]] LineReader& lines() { return lines_; }
  [[nodiscard]] TableBuilder& table() { return table_; }
  [[nodiscard]] const ReadOptions& options() const { return options_; }

  /// Splits the next line that has fields; # begins a comment. Returns false at the end. Error (input): some
  /// fields are separated by commas and others by blanks alone.
  Result<bool> next();
  /// The fields of that line.
  [[nodiscard]] std::span<const std::string_view> fields() const { return fields_; }

  /// Takes the columns of all rows from their names, those of --columns if there are some; others are
  /// attributes. Error (input), at `column` of the last line: none of them is x, y or, in space, z.
  Result<void> takeNames(std::span<const std::string> names, std::size_t column = 1);

  /// Takes x, y, in space z, and perhaps weights from these columns of rows of `count`.
  void takeColumns(std::vector<std::size_t> columns, std::size_t count);
  /// Makes a column an attribute.
  void takeAttribute(std::size_t column, std::string_view name);

  /// Where columns of sites in space are; another function of their three numbers is the place.
  void placeBy(std::function<Point3(const std::array<double, 3>&)> place) { place_ = std::move(place); }
  /// Numbers are twice those that weights stand for.
  void halveWeights() { weight_factor_ = 0.5; }
  [[nodiscard]] std::span<const std::size_t> columns() const { return columns_; }

  /// Adds the row in fields(). Errors (input), with line and column.
  Result<void> take();

  /// Whether something after the last row is worth a note.
  enum class Rest : std::uint8_t { noted, unnoted };

  /// Adds `count` rows after `before`. Error (input): the file ends before.
  Result<void> takeRows(std::uint64_t count, std::uint64_t before = 0, Rest rest = Rest::noted);

  /// Returns the table, with types of its attributes. Call once.
  SiteTable finish();

 private:
  Result<void> noteRest(std::uint64_t count);
  Result<void> addRow(const std::array<double, space_numbers.size()>& value);

  LineReader lines_;
  const ReadOptions& options_;
  TableBuilder table_;
  std::string_view line_;
  std::vector<std::string_view> fields_;
  std::size_t count_ = 0;             ///< of fields in each row
  bool named_ = false;                ///< whether a header says so
  std::vector<std::size_t> columns_;  ///< of x, y, in space z, and perhaps weight
  WeightKind weight_kind_ = WeightKind::weight;
  double weight_factor_ = 1;
  std::function<Point3(const std::array<double, 3>&)> place_;
  /// Columns of the file and of the attributes.
  std::vector<std::pair<std::size_t, std::size_t>> attributes_;
};

}  // namespace vorpipe
