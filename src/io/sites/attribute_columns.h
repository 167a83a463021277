/// Attributes as a file gives them: row by row, where not every row need have all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"

namespace vorpipe {

class AttributeColumns {
 public:
  /// Where they are not kept, names alone are.
  explicit AttributeColumns(bool kept) : kept_(kept) {}

  /// The column of that name, which is made where there is none.
  std::size_t column(std::string_view name);

  /// A column of its own: where the name is taken, it gets a number.
  std::size_t newColumn(std::string_view name);

  /// What a column is that has no values in the end.
  void setType(std::size_t column, AttributeType type) { columns_[column].setType(type); }

  /// The value of the row that is being read, once for a column and row; else it is missing. `text` as
  /// Attribute::at has it. A column of several types becomes the narrowest type that holds them all.
  void set(std::size_t column, AttributeType type, std::string_view text);

  /// The value of the row that is being read, until it ends; none where it is missing.
  [[nodiscard]] std::optional<std::string_view> rowValue(std::string_view name) const;
  [[nodiscard]] bool has(std::string_view name) const { return by_name_.contains(name); }

  /// Ends the row, which is that of `sites` sites; 0 leaves it out.
  void endRow(std::size_t sites = 1);

  /// Leaves out all rows up to now; their columns stay.
  void clearRows();

  /// Memory for as many sites: each column has an entry for each of them in the end.
  [[nodiscard]] std::uint64_t bytes(std::uint64_t sites) const;

  [[nodiscard]] bool kept() const { return kept_; }
  [[nodiscard]] std::size_t size() const { return columns_.size(); }
  [[nodiscard]] const std::string& name(std::size_t column) const { return columns_[column].name(); }

  /// All columns, each as long as there are sites. None where they are not kept.
  std::vector<Attribute> take();

 private:
  struct Named {
    std::size_t column;
    std::size_t next = 2;  ///< number for another of that name
  };
  struct Value {
    std::size_t column, end;  ///< where it ends in row_text_
    AttributeType type;
  };
  void add(const Value& value, std::string_view text, std::size_t sites);

  bool kept_;
  std::size_t sites_ = 0;
  std::vector<Attribute> columns_;
  std::vector<bool> has_values_;
  std::map<std::string, Named, std::less<>> by_name_;
  std::vector<Value> row_;
  std::string row_text_;  ///< the values of row_, one after the other
};

}  // namespace vorpipe
