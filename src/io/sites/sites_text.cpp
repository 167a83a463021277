#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "base/words.h"
#include "io/base/error.h"
#include "io/base/line_reader.h"
#include "io/base/number.h"
#include "io/sites/site_columns.h"
#include "io/sites/sites_reader.h"
#include "io/sites/table_builder.h"

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

/// Whether a field is a common spelling of a number that is not finite.
bool isNotFinite(std::string_view field) {
  const std::string word = lowerCase(field.substr(field.starts_with('-') || field.starts_with('+') ? 1 : 0));
  return word == "nan" || word == "inf" || word == "infinity";
}

/// Also reads the .xyz of chemistry in space: the number of sites, a comment, and lines of an element, x, y,
/// z and perhaps more.
class TextSites {
 public:
  TextSites(LineReader lines, const ReadOptions& options)
      : lines_(std::move(lines)), options_(options), table_(lines_.name(), options) {}

  Result<SiteTable> read() {
    while (true) {
      if (expected_ && rows_ == *expected_) {
        VORPIPE_TRY(noteRest());
        return table_.finish();
      }
      VORPIPE_LET(line, lines_.next());
      if (!line && expected_) {
        return inputError(fmt::format("{}: ends after {} of {} sites", lines_.name(), rows_, *expected_));
      }
      if (!line) return table_.finish();
      if (const auto column = split(*line, fields_)) {
        return lines_.errorAt(*column,
                              "the row has commas and blanks between its fields, so that nothing tells which "
                              "commas are decimal; keep one of them, and write 1.5, not 1,5");
      }
      if (fields_.empty()) continue;
      if (beginsFrame()) {
        VORPIPE_TRY(readComment());
        continue;
      }
      VORPIPE_TRY(readRow(*line));
      ++rows_;
    }
  }

 private:
  /// Whether the first row names columns: none of its fields is a number.
  [[nodiscard]] bool isHeader() const {
    return fields_.size() > 1 && std::ranges::none_of(fields_, [](std::string_view field) {
             return field.empty() || parseNumber(field).has_value() || isNotFinite(field);
           });
  }

  /// Whether the first row is a number of sites, which a comment follows.
  [[nodiscard]] bool beginsFrame() {
    if (options_.third != Third::z || count_ > 0 || expected_ || fields_.size() != 1) return false;
    expected_ = wholeNumber<std::uint64_t>(fields_[0]);
    return expected_.has_value();
  }

  Result<void> readComment() {
    VORPIPE_LET(comment, lines_.next());
    if (comment && comment->find("Lattice=") != std::string_view::npos)
      table_.note("its lattice is not used: cells in space have no periods");
    return {};
  }

  /// Notes that more follows than the sites that were announced.
  Result<void> noteRest() {
    while (true) {
      VORPIPE_LET(line, lines_.next());
      if (!line) return {};
      if (trimmed(*line).empty()) continue;
      table_.note(fmt::format("what follows its first {} sites is not read", *expected_));
      return {};
    }
  }

  /// Takes from the first row of a frame what applies to all.
  Result<void> readFirstOfFrame() {
    constexpr std::size_t fewest = 4;
    if (count_ < fewest || !options_.columns.empty()) {
      return lines_.errorAt(
          1, options_.columns.empty()
                 ? fmt::format("the row has {} fields; an element, x, y and z are needed", count_)
                 : "of a file of elements and positions no columns are chosen");
    }
    columns_ = {1, 2, 3};
    attributes_.emplace_back(0, table_.attributes().newColumn("element"));
    for (std::size_t k = fewest; k < count_; ++k)
      attributes_.emplace_back(k, table_.attributes().newColumn(fmt::format("column_{}", k + 1)));
    return {};
  }

  /// Takes from a header what applies to all rows.
  Result<void> readHeader() {
    const std::vector<std::string> names(fields_.begin(), fields_.end());
    auto columns = namedColumns(names, options_.columns, options_.third);
    if (!columns) return lines_.errorAt(1, columns.error().what);
    if (!columns->x) return lines_.errorAt(1, "a column of WKT has blanks of its own, which separate fields");
    columns_ = {*columns->x, *columns->y};
    if (columns->weight) columns_.push_back(*columns->weight);
    weight_kind_ = columns->weight_kind;
    table_.system().kind = columns->kind;
    if (!columns->note.empty()) table_.note(columns->note);
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (!columns->has(k)) attributes_.emplace_back(k, table_.attributes().newColumn(names[k]));
    }
    return {};
  }

  /// Takes from the first row what applies to all.
  Result<void> readFirst() {
    count_ = fields_.size();
    if (expected_) return readFirstOfFrame();
    const bool space = options_.third == Third::z;
    if (options_.columns.empty() && space && count_ != space_numbers.size()) {
      return lines_.errorAt(1, fmt::format("the row has {} field{}; x y z is needed, or --columns", count_,
                                           count_ == 1 ? "" : "s"));
    }
    if (options_.columns.empty()) {
      if (count_ < 2 || count_ > site_numbers.size()) {
        return lines_.errorAt(
            1, fmt::format("the row has {} field{}; x y or x y weight is needed, or --columns", count_,
                           count_ == 1 ? "" : "s"));
      }
      if (count_ == site_numbers.size() && !space) table_.note(third_is_weight);
      for (std::size_t k = 0; k < count_; ++k) columns_.push_back(k);
      return {};
    }
    VORPIPE_VAR(columns, numberedColumns(options_.columns, count_, lines_.name(), options_.third));
    columns_ = std::move(columns);
    // Columns left out by number need no note.
    for (std::size_t k = 0; k < count_ && options_.attributes; ++k) {
      if (std::ranges::find(columns_, k) != columns_.end()) continue;
      attributes_.emplace_back(k, table_.attributes().newColumn(fmt::format("column_{}", k + 1)));
    }
    return {};
  }

  Result<void> readRow(std::string_view line) {
    if (count_ == 0 && !expected_ && isHeader()) {
      count_ = fields_.size();
      return readHeader();
    }
    if (count_ == 0) {
      VORPIPE_TRY(readFirst());
    }
    if (fields_.size() != count_) {
      return lines_.errorAt(
          1, fmt::format("the row has {} fields, the rows before it {}", fields_.size(), count_));
    }
    std::array<double, site_numbers.size()> value{};
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const std::string_view field = fields_[columns_[i]];
      const auto number = parseNumber(field);
      if (!number) {
        const auto missing =
            isMissingValue(field) ? table_.addMissingValue(field) : RowProblem(number.error());
        if (!missing) return {};
        const auto column = static_cast<std::size_t>(field.data() - line.data()) + 1;
        return lines_.errorAt(column, fmt::format("{} (column {})", *missing, namesOf(options_.third)[i]));
      }
      value[i] = *number;
    }
    for (const auto& [from, to] : attributes_) {
      if (!fields_[from].empty()) table_.attributes().set(to, AttributeType::text, fields_[from]);
    }
    std::optional<double> weight;
    if (columns_.size() == site_numbers.size()) {
      const auto valid = weightOf(weight_kind_, value[2], fields_[columns_[2]]);
      if (!valid) return lines_.errorAt(1, fmt::format("{} (column {})", valid.error(), site_numbers[2]));
      weight = *valid;
    }
    table_.setPlace([&] { return fmt::format("line {}", lines_.number()); });
    if (const auto problem = table_.addRow(std::array{Point{value[0], value[1]}}, weight)) {
      return lines_.errorAt(1, *problem);
    }
    return {};
  }

  LineReader lines_;
  const ReadOptions& options_;
  TableBuilder table_;
  std::vector<std::string_view> fields_;
  std::size_t count_ = 0;                  ///< of fields in each row; 0 before the first
  std::optional<std::uint64_t> expected_;  ///< sites, if the file says how many
  std::uint64_t rows_ = 0;
  std::vector<std::size_t> columns_;  ///< of x, y and perhaps weight
  WeightKind weight_kind_ = WeightKind::weight;
  std::vector<std::pair<std::size_t, std::size_t>>
      attributes_;  ///< columns of the file and of the attributes
};

}  // namespace

Result<SiteTable> readTextSites(InputFile file, const ReadOptions& options) {
  auto table = TextSites(LineReader(std::move(file)), options).read();
  if (!table) return table;
  for (Attribute& attribute : table->attributes) attribute.inferType();
  return table;
}

}  // namespace vorpipe
