#include "io/sites/text_rows.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/number.h"

namespace vorpipe {
namespace {

/// Fields are separated by blanks or by one comma with blanks around it: "1, ,2" has an empty field. If a
/// line has both, such as "1,5 2,5", it is unknown which commas are decimal. Returns the column where that
/// shows, counted from 1.
std::optional<std::size_t> split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  const char* const begin = line.data();
  line = trimmed(line.substr(0, line.find('#')));
  bool commas = false, blanks = false;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find_first_of(" \t,"), line.size());
    fields.push_back(line.substr(0, end));
    line.remove_prefix(end);
    if (line.empty()) break;
    const auto column = static_cast<std::size_t>(line.data() - begin) + 1;
    line = trimmed(line);
    const bool comma = line.starts_with(',');
    (comma ? commas : blanks) = true;
    if (commas && blanks) return column;
    if (!comma) continue;
    line = trimmed(line.substr(1));
    if (line.empty()) fields.emplace_back(line);
  }
  return std::nullopt;
}

}  // namespace

Result<bool> TextRows::next() {
  while (true) {
    VORPIPE_LET(line, lines_.next());
    if (!line) return false;
    line_ = *line;
    if (const auto column = split(line_, fields_)) {
      return lines_.errorAt(*column,
                            "the row has commas and blanks between its fields, so that nothing tells which "
                            "commas are decimal; keep one of them, and write 1.5, not 1,5");
    }
    if (!fields_.empty()) return true;
  }
}

Result<void> TextRows::takeNames(std::span<const std::string> names, std::size_t column) {
  auto found = namedColumns(names, options_.columns, options_.third);
  if (!found) return lines_.errorAt(column, found.error().what);
  if (!found->x)
    return lines_.errorAt(column, "a column of WKT has blanks of its own, which separate fields");
  columns_ = {*found->x, *found->y};
  if (found->z) columns_.push_back(*found->z);
  if (found->weight) columns_.push_back(*found->weight);
  weight_kind_ = found->weight_kind;
  table_.system().kind = found->kind;
  if (!found->note.empty()) table_.note(found->note);
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!found->has(k)) takeAttribute(k, names[k]);
  }
  count_ = names.size();
  named_ = true;
  return {};
}

void TextRows::takeColumns(std::vector<std::size_t> columns, std::size_t count) {
  columns_ = std::move(columns);
  count_ = count;
}

void TextRows::takeAttribute(std::size_t column, std::string_view name) {
  attributes_.emplace_back(column, table_.attributes().newColumn(name));
}

Result<void> TextRows::addRow(const std::array<double, space_numbers.size()>& value) {
  std::array<double, 3> at{value[0], value[1], value[2]};
  if (place_) {
    const Point3 place = place_(at);
    at = {place.x, place.y, place.z};
    if (!std::ranges::all_of(at, [](double number) { return std::isfinite(number); }))
      return lines_.errorAt(1, "the place is out of the range of a double");
  }
  std::optional<double> weight, z;
  if (options_.third == Third::z) z = at[2];
  const auto names = namesOf(options_.third);
  if (columns_.size() == names.size()) {
    const auto valid =
        weightOf(weight_kind_, weight_factor_ * value[names.size() - 1], fields_[columns_.back()]);
    if (!valid) return lines_.errorAt(1, fmt::format("{} (column {})", valid.error(), names.back()));
    weight = *valid;
  }
  table_.setPlace([&] { return fmt::format("line {}", lines_.number()); });
  if (const auto problem = table_.addRow(std::array{Point{at[0], at[1]}}, weight, z)) {
    return lines_.errorAt(1, *problem);
  }
  return {};
}

Result<void> TextRows::take() {
  if (fields_.size() != count_) {
    return lines_.errorAt(1, fmt::format("the row has {} fields, the {} {}", fields_.size(),
                                         named_ ? "header" : "rows before it", count_));
  }
  std::array<double, space_numbers.size()> value{};
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::string_view field = fields_[columns_[i]];
    const auto number = parseNumber(field);
    if (!number) {
      const auto missing = isMissingValue(field) ? table_.addMissingValue(field) : RowProblem(number.error());
      if (!missing) return {};
      const auto column = static_cast<std::size_t>(field.data() - line_.data()) + 1;
      return lines_.errorAt(column, fmt::format("{} (column {})", *missing, namesOf(options_.third)[i]));
    }
    value[i] = *number;
  }
  for (const auto& [from, to] : attributes_) {
    if (!fields_[from].empty()) table_.attributes().set(to, AttributeType::text, fields_[from]);
  }
  return addRow(value);
}

Result<void> TextRows::takeRows(std::uint64_t count, std::uint64_t before, Rest rest) {
  for (std::uint64_t row = 0; row < count; ++row) {
    VORPIPE_LET(there, next());
    if (!there)
      return inputError(
          fmt::format("{}: ends after {} of {} sites", lines_.name(), before + row, before + count));
    VORPIPE_TRY(take());
  }
  return rest == Rest::noted ? noteRest(before + count) : Result<void>();
}

/// Notes that more follows than the sites that were announced.
Result<void> TextRows::noteRest(std::uint64_t count) {
  while (true) {
    VORPIPE_LET(line, lines_.next());
    if (!line) return {};
    if (trimmed(*line).empty()) continue;
    table_.note(fmt::format("what follows its first {} sites is not read", count));
    return {};
  }
}

SiteTable TextRows::finish() {
  SiteTable table = table_.finish();
  for (Attribute& attribute : table.attributes) attribute.inferType();
  return table;
}

}  // namespace vorpipe
