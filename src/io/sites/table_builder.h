/// A SiteTable, row by row.
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

  /// Of the row that addRow or addMissing ends.
  AttributeColumns& attributes() { return attributes_; }
  CoordinateSystem& system() { return table_.system; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool skipsMissing() const { return skip_missing_; }

  /// Ends a row: each point is a site, with the row's weight and attributes. A row has a weight if those
  /// before have one, and the attribute that is needed, once one had it.
  RowProblem addRow(std::span<const Point> points, std::optional<double> weight);

  /// Whether what addRow refused was the value of the attribute that is needed.
  [[nodiscard]] bool refusedNeeded() const { return refused_needed_; }

  /// Ends a row that lacks something: `what` is wrong, unless such rows are to be left out.
  RowProblem addMissing(std::string_view what);

  /// The same for a field of which isMissingValue holds.
  RowProblem addMissingValue(std::string_view field);

  /// "FILE: what" is said once.
  void note(std::string_view what);
  /// Positions have more than x and y.
  void noteHeights() { heights_ = true; }

  /// The table; notes say what was left out. Call once.
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
                         << 12;  ///< as many sites have room; checked again when there are more
  bool heights_ = false;
};

}  // namespace vorpipe
