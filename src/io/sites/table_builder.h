/// Builds a SiteTable row by row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/base/attribute.h"
#include "io/sites/sites_file.h"

namespace vorpipe {

/// Collects attributes of a file row by row; a row may lack some of them.
class AttributeColumns {
 public:
  /// Unless `kept`, keeps only the names.
  explicit AttributeColumns(bool kept) : kept_(kept) {}

  /// Returns the column of that name; makes it if there is none.
  std::size_t column(std::string_view name);

  /// Makes a new column; appends a number if the name is taken.
  std::size_t newColumn(std::string_view name);

  /// Sets the type of a column that ends up without values.
  void setType(std::size_t column, AttributeType type) { columns_[column].setType(type); }

  /// Sets a value of the current row, once per column and row; a value not set is missing. `text` is as in
  /// Attribute::at. A column of several types becomes the narrowest type that holds them all.
  void set(std::size_t column, AttributeType type, std::string_view text);

  /// Returns a value of the current row, until the row ends; none if it is missing.
  [[nodiscard]] std::optional<std::string_view> rowValue(std::string_view name) const;
  [[nodiscard]] bool has(std::string_view name) const { return by_name_.contains(name); }
  /// Returns the name of a column: this one, else the only one that differs in case alone, else `name`.
  [[nodiscard]] std::string nameLike(std::string_view name) const;

  /// Ends the row, which applies to `sites` sites; 0 leaves it out.
  void endRow(std::size_t sites = 1);

  /// Leaves out all rows so far; their columns stay.
  void clearRows();

  /// Bytes of memory for `sites` sites: in the end, each column has an entry for each site.
  [[nodiscard]] std::uint64_t bytes(std::uint64_t sites) const;

  [[nodiscard]] bool kept() const { return kept_; }
  [[nodiscard]] std::size_t size() const { return columns_.size(); }
  [[nodiscard]] const std::string& name(std::size_t column) const { return columns_[column].name(); }

  /// Returns all columns, each as long as there are sites. None unless they are kept.
  std::vector<Attribute> take();

 private:
  struct Named {
    std::size_t column;
    std::size_t next = 2;  ///< number for another of that name
  };
  struct Value {
    std::size_t column;
    AttributeType type;
    std::size_t begin, size;  ///< of its text in row_text_
  };
  [[nodiscard]] std::string_view textOf(const Value& value) const {
    return std::string_view(row_text_).substr(value.begin, value.size);
  }
  void add(const Value& value, std::string_view text, std::size_t sites);

  bool kept_;
  std::size_t sites_ = 0;
  std::vector<Attribute> columns_;
  std::vector<bool> has_values_;
  std::map<std::string, Named, std::less<>> by_name_;
  std::vector<Value> row_;
  std::string row_text_;  ///< the values of row_, one after the other
};

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

  /// Ends a row: each point is a site, with the row's weight and attributes, in space with z. A row must have
  /// a weight if those before have one, and the needed attribute once a row had it.
  RowProblem addRow(std::span<const Point> points, std::optional<double> weight,
                    std::optional<double> z = {});

  /// Sets the place of the row that addRow ends, as `place()` says it in words that follow "that of".
  template <class Place>
  void setPlace(const Place& place) {
    if (needed_ && needed_->unique) place_ = place();
  }

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
  RowProblem checkNeeded(std::string_view value, std::size_t points);
  RowProblem checkUnique(std::string_view value, std::size_t points);
  void leaveOutRows();

  std::string name_;
  bool skip_missing_;
  std::optional<NeededAttribute> needed_;
  bool refused_needed_ = false, has_needed_ = false;
  std::string place_;                                      ///< of the row, if values must be unique
  std::unordered_map<std::string, std::string> place_of_;  ///< of the row with a value, likewise
  AttributeColumns attributes_;
  SiteTable table_{};
  std::uint64_t rows_ = 0;
  std::size_t checked_ = std::size_t{1}
                         << 12;  ///< sites known to have room; checked again when there are more
  bool heights_ = false;
};

}  // namespace vorpipe
