#include "io/sites/table_builder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/words.h"
#include "io/base/field_text.h"
#include "io/base/input_file.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/sites/site_domain.h"

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

/// Lists the first names, and the number of the others.
std::string listed(const AttributeColumns& columns) {
  constexpr std::size_t most = 5;
  std::vector<std::string_view> names;
  for (std::size_t k = 0; k < std::min(most, columns.size()); ++k) names.push_back(columns.name(k));
  const std::string rest = columns.size() > most ? fmt::format(" and {} more", columns.size() - most) : "";
  return fmt::format("{}{}", fmt::join(names, ", "), rest);
}

}  // namespace

std::size_t AttributeColumns::column(std::string_view name) {
  const auto named = by_name_.find(name);
  return named == by_name_.end() ? newColumn(name) : named->second.column;
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
  row_.push_back({column, type, row_text_.size(), text.size()});
  row_text_ += text;
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
  const auto named = by_name_.find(name);
  if (named == by_name_.end()) return std::nullopt;
  const auto value = std::ranges::find(row_, named->second.column, &Value::column);
  return value == row_.end() ? std::nullopt : std::optional(textOf(*value));
}

std::string AttributeColumns::nameLike(std::string_view name) const {
  std::string only(name);
  if (has(name)) return only;
  std::size_t count = 0;
  for (const auto& [other, column] : by_name_) {
    if (lowerCase(other) != lowerCase(name)) continue;
    only = other;
    ++count;
  }
  return count == 1 ? only : std::string(name);
}

void AttributeColumns::endRow(std::size_t sites) {
  for (const Value& value : row_) {
    if (sites > 0) add(value, textOf(value), sites);
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

/// Checks that twice the present sites fit into memory. A small file may need much if it is packed, or if its
/// rows have different attributes, each of which is a column.
RowProblem TableBuilder::checkRoom() {
  const Sites& sites = table_.sites;
  checked_ = 2 * std::max(checked_, sites.size());
  const std::uint64_t of_site = (sites.weight.empty() ? 2 : 3) * sizeof(double);
  const auto what = fmt::format("{} sites up to here", sites.size());
  const auto room = vorpipe::checkRoom(name_, what, checked_ * of_site + attributes_.bytes(checked_));
  if (room) return {};
  return room.error().message.substr(name_.size() + 2);
}

/// Returns what is wrong with a value that another row has as well.
RowProblem TableBuilder::checkUnique(std::string_view value, std::size_t points) {
  if (points > 1) return fmt::format("{} stands for {} places, which need one each", inQuotes(value), points);
  const auto [first, added] = place_of_.try_emplace(std::string(value), place_);
  if (added) return {};
  return fmt::format("{} is that of {} as well; each site needs another", inQuotes(value), first->second);
}

/// Returns what is wrong with a row's needed value.
RowProblem TableBuilder::checkNeeded(std::string_view value, std::size_t points) {
  const std::string column = fmt::format(" (column {})", printable(needed_->name));
  refused_needed_ = true;
  if (isMissingValue(value)) {
    const auto problem = addMissingValue(trimmed(value));
    return problem ? *problem + column : RowProblem{};
  }
  const auto right = needed_->check(value);
  RowProblem problem = right ? RowProblem{} : right.error();
  if (!problem && needed_->unique) problem = checkUnique(value, points);
  refused_needed_ = problem.has_value();
  return problem ? *problem + column : problem;
}

/// Leaves out all rows so far, which lack an attribute that a later one has.
void TableBuilder::leaveOutRows() {
  table_.skipped += rows_;
  rows_ = 0;
  table_.sites = {};
  table_.z = {};
  attributes_.clearRows();
}

RowProblem TableBuilder::addRow(std::span<const Point> points, std::optional<double> weight,
                                std::optional<double> z) {
  Sites& sites = table_.sites;
  if (sites.size() + points.size() > max_sites)
    return fmt::format("the file holds more than {} sites", max_sites);
  const bool weighted = !sites.weight.empty();
  if (rows_ > 0 && weighted && !weight) return addMissing("has no weight, and those before it have");
  if (rows_ > 0 && !weighted && weight) {
    if (!skip_missing_) return "has a weight, and those before it have none";
    leaveOutRows();
  }
  if (needed_ && !has_needed_) needed_->name = attributes_.nameLike(needed_->name);
  if (needed_ && attributes_.has(needed_->name)) {
    if (!std::exchange(has_needed_, true) && rows_ > 0) {
      if (!skip_missing_)
        return fmt::format("has {}, and those before it have none", inQuotes(needed_->name));
      leaveOutRows();
    }
    const auto problem = checkNeeded(attributes_.rowValue(needed_->name).value_or(""), points.size());
    if (problem || refused_needed_) return problem;
  }
  for (const Point& point : points) {
    if (weight) sites.weight.push_back(*weight);
    if (z) table_.z.push_back(*z);
    sites.x.push_back(point.x);
    sites.y.push_back(point.y);
  }
  ++rows_;
  attributes_.endRow(points.size());
  return sites.size() > checked_ ? checkRoom() : RowProblem{};
}

RowProblem TableBuilder::addMissing(std::string_view what) {
  if (!skip_missing_) return std::string(what);
  attributes_.endRow(0);
  ++table_.skipped;
  return {};
}

RowProblem TableBuilder::addMissingValue(std::string_view field) {
  return addMissing(fmt::format("{}; --missing skip leaves such rows out",
                                field.empty() ? "empty field" : inQuotes(field) + " is no value"));
}

void TableBuilder::note(std::string_view what) { table_.notes.push_back(fmt::format("{}: {}", name_, what)); }

SiteTable TableBuilder::finish() {
  if (const auto what = settleDegrees(table_.sites, table_.system); !what.empty()) note(what);
  if (heights_) note("of positions x and y are taken, and nothing of their other numbers");
  if (table_.skipped > 0) {
    note(fmt::format("{} row{} without a place or a weight{} {} left out", table_.skipped,
                     table_.skipped == 1 ? "" : "s", needed_ ? " or " + inQuotes(needed_->name) : "",
                     table_.skipped == 1 ? "is" : "are"));
  }
  if (!attributes_.kept() && attributes_.size() > 0) note("not used: " + listed(attributes_));
  table_.attributes = attributes_.take();
  return std::move(table_);
}

}  // namespace vorpipe
