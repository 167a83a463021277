/// Builds a SiteTable row by row.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/sites/attribute_columns.h"
#include "io/sites/site_table.h"

namespace vorpipe {

/// What is wrong with a row, in words that continue its place.
using RowProblem = std::optional<std::string>;

class TableBuilder {
 public:
  /// `name` is the file's, for notes.
  TableBuilder(std::string name, const ReadOptions& options)
      : name_(std::move(name)),
        skip_missing_(options.skip_missing),
        needed_(options.needed),
        attributes_(options.attributes) {}

  /// Attributes of the row that addRow or addMissing ends.
  AttributeColumns& attributes() { return attributes_; }
  CoordinateSystem& system() { return table_.system; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool skipsMissing() const { return skip_missing_; }

  /// Ends a row: each point is a site, with the row's weight and attributes. A row must have a weight if
  /// those before have one, and the needed attribute once a row had it.
  RowProblem addRow(std::span<const Point> points, std::optional<double> weight);

  /// Whether addRow refused the value of the needed attribute.
  [[nodiscard]] bool refusedNeeded() const { return refused_needed_; }

  /// Ends a row that lacks something; returns `what` as a problem unless such rows are left out.
  RowProblem addMissing(std::string_view what);

  /// The same for a field for which isMissingValue holds.
  RowProblem addMissingValue(std::string_view field);

  /// Adds the note "FILE: what", once.
  void note(std::string_view what);
  /// Notes that positions have more than x and y.
  void noteHeights() { heights_ = true; }

  /// Returns the table; notes list what was left out. Call once.
  SiteTable finish();

 private:
  RowProblem checkRoom();
  RowProblem checkNeeded(std::string_view value);
  void leaveOutRows();

  std::string name_;
  bool skip_missing_;
  std::optional<NeededAttribute> needed_;
  bool refused_needed_ = false, has_needed_ = false;
  AttributeColumns attributes_;
  SiteTable table_{};
  std::uint64_t rows_ = 0;
  std::size_t checked_ = std::size_t{1}
                         << 12;  ///< sites known to have room; checked again when there are more
  bool heights_ = false;
};

}  // namespace vorpipe
