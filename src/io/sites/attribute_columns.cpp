#include "io/sites/attribute_columns.h"

#include <fmt/core.h>

#include <utility>

#include "io/base/json_text.h"

namespace vorpipe {
namespace {

/// Returns the narrowest type that holds values of both.
AttributeType typeOf(AttributeType a, AttributeType b) {
  const auto isNumber = [](AttributeType type) {
    return type == AttributeType::integer || type == AttributeType::real;
  };
  if (a == b) return a;
  return isNumber(a) && isNumber(b) ? AttributeType::real : AttributeType::json;
}

void fill(Attribute& attribute, std::size_t sites) {
  while (attribute.size() < sites) attribute.add(std::nullopt);
}

}  // namespace

std::size_t AttributeColumns::column(std::string_view name) {
  const auto known = by_name_.find(name);
  return known == by_name_.end() ? newColumn(name) : known->second.column;
}

std::size_t AttributeColumns::newColumn(std::string_view name) {
  std::string unique(name);
  // Taken numbers stay taken: a header that repeats one name does not take quadratic work.
  const auto same = by_name_.find(name);
  while (by_name_.contains(unique)) unique = fmt::format("{}_{}", name, same->second.next++);
  by_name_.emplace(unique, Named{columns_.size()});
  columns_.emplace_back(std::move(unique));
  has_values_.push_back(false);
  return columns_.size() - 1;
}

void AttributeColumns::set(std::size_t column, AttributeType type, std::string_view text) {
  if (!kept_) return;
  row_text_ += text;
  row_.push_back({column, row_text_.size(), type});
}

void AttributeColumns::add(const Value& value, std::string_view text, std::size_t sites) {
  Attribute& attribute = columns_[value.column];
  const AttributeType type = has_values_[value.column] ? typeOf(attribute.type(), value.type) : value.type;
  // Earlier text values become JSON strings, since the column now holds other JSON.
  if (type == AttributeType::json && attribute.type() == AttributeType::text)
    attribute = attribute.rewritten(AttributeType::json, jsonString);
  has_values_[value.column] = true;
  attribute.setType(type);
  fill(attribute, sites_);
  const bool quotes = type == AttributeType::json && value.type == AttributeType::text;
  const std::string json = quotes ? jsonString(text) : std::string();
  for (std::size_t k = 0; k < sites; ++k) attribute.add(quotes ? std::string_view(json) : text);
}

std::optional<std::string_view> AttributeColumns::rowValue(std::string_view name) const {
  const auto known = by_name_.find(name);
  std::size_t begin = 0;
  for (const Value& value : row_) {
    if (known != by_name_.end() && value.column == known->second.column)
      return std::string_view(row_text_).substr(begin, value.end - begin);
    begin = value.end;
  }
  return std::nullopt;
}

void AttributeColumns::endRow(std::size_t sites) {
  std::size_t begin = 0;
  for (const Value& value : row_) {
    if (sites > 0) add(value, std::string_view(row_text_).substr(begin, value.end - begin), sites);
    begin = value.end;
  }
  sites_ += sites;
  row_.clear();
  row_text_.clear();
}

std::uint64_t AttributeColumns::bytes(std::uint64_t sites) const {
  if (!kept_) return 0;
  std::uint64_t bytes = columns_.size() * sites * sizeof(std::uint64_t);
  for (const Attribute& attribute : columns_) bytes += attribute.bytes();
  return bytes;
}

void AttributeColumns::clearRows() {
  for (Attribute& attribute : columns_) attribute = Attribute(attribute.name(), attribute.type());
  has_values_.assign(columns_.size(), false);
  sites_ = 0;
}

std::vector<Attribute> AttributeColumns::take() {
  if (!kept_) return {};
  for (Attribute& attribute : columns_) fill(attribute, sites_);
  return std::move(columns_);
}

}  // namespace vorpipe
