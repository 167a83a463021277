#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "base/try.h"
#include "base/words.h"
#include "io/base/csv_reader.h"
#include "io/base/error.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/sites/site_columns.h"
#include "io/sites/sites_reader.h"
#include "io/sites/table_builder.h"

namespace vorpipe {
namespace {

/// Text of fields as UTF-8.
class CsvText {
 public:
  /// Returns a field of the last record; valid until the next call.
  std::string_view of(const CsvReader& csv, std::size_t field) {
    const std::string_view bytes = csv.field(field);
    if (isUtf8(bytes)) return bytes;
    if (other_line_ == 0) other_line_ = csv.line();
    text_ = fromWindows1252(bytes);
    return text_;
  }

  /// The first line with a field that was not UTF-8; 0 if there is none.
  [[nodiscard]] std::uint64_t otherLine() const { return other_line_; }

 private:
  std::string text_;
  std::uint64_t other_line_ = 0;
};

std::string withPoint(std::string_view text) {
  std::string number(text);
  std::ranges::replace(number, ',', '.');
  return number;
}

/// Whether the comma may be a thousands separator: three digits follow.
bool mayBeThousands(std::string_view text) {
  constexpr std::size_t digits = 3;
  return text.size() - text.find(',') - 1 == digits;
}

/// Whether all values are numbers, some with a comma and none with a point.
bool haveDecimalCommas(const Attribute& attribute, DecimalMark mark) {
  bool any = false, thousands = true;
  for (std::size_t site = 0; site < attribute.size(); ++site) {
    const auto value = attribute.at(site);
    if (!value) continue;
    const auto commas = std::ranges::count(*value, ',');
    if (commas > 1 || value->find('.') != std::string_view::npos || !isJsonNumber(withPoint(*value)))
      return false;
    any = any || commas == 1;
    thousands = thousands && (commas == 0 || mayBeThousands(*value));
  }
  return any && (mark == DecimalMark::comma || !thousands);
}

/// Converts numbers with decimal commas to JSON numbers if all values are numbers. `mark` is the decimal mark
/// of the file's coordinates. If they have none, an attribute of only values like 1,234 stays text: commas
/// may mark thousands.
Attribute withDecimalPoints(Attribute attribute, DecimalMark mark) {
  if (mark == DecimalMark::point || !haveDecimalCommas(attribute, mark)) return attribute;
  return attribute.rewritten(attribute.type(), withPoint);
}

class CsvSites {
 public:
  CsvSites(CsvReader csv, const ReadOptions& options)
      : csv_(std::move(csv)), options_(options), table_(csv_.name(), options) {}

  Result<SiteTable> read() {
    VORPIPE_LET(first, csv_.next());
    if (!first) {
      return inputError(csv_.name() + ": is empty; its first line must name the columns, as in \"x,y\"");
    }
    auto row = readFirst();
    while (row) {
      if (are_pairs_) row = readPairs();
      if (!row) break;
      VORPIPE_LET(more, csv_.next());
      if (!more) return finish();
      row = readRow();
    }
    return tl::unexpected(row.error());
  }

 private:
  /// Reads the header, or the first row if there is none.
  Result<void> readFirst() {
    const auto places = positionsWithoutHeader(options_.columns);
    const bool header = !places || !isNumber(places->first) || !isNumber(places->second);
    names_.resize(csv_.fields());
    for (std::size_t k = 0; k < names_.size() && header; ++k) names_[k] = text_.of(csv_, k);
    auto columns = header ? namedColumns(names_, options_.columns, options_.third)
                          : unnamedColumns(names_.size(), leadingNumbers(), options_.columns, options_.third);
    if (!columns) return csv_.errorAt(columns.error().column, columns.error().what);
    columns_ = std::move(*columns);
    table_.system().kind = columns_.kind;
    if (!columns_.note.empty()) table_.note(columns_.note);
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (names_[k].empty()) names_[k] = fmt::format("column_{}", k + 1);
      if (columns_.has(k)) continue;
      if (lowerCase(names_[k]) == "z" && !options_.advice_on_z.empty())
        table_.note(
            fmt::format("column {} is no place in the plane{}", inQuotes(names_[k]), options_.advice_on_z));
      attributes_.push_back({k, table_.attributes().newColumn(names_[k])});
      if (options_.needed && lowerCase(names_[k]) == lowerCase(options_.needed->name) &&
          names_[needed_] != options_.needed->name) {
        needed_ = k;
      }
    }
    const bool plain = columns_.x && columns_.y && !columns_.z && !columns_.weight && !options_.needed;
    are_pairs_ = plain && names_.size() == 2 && csv_.separator() == ',';
    return header ? Result<void>() : readRow();
  }

  /// Reads the following lines as long as they are just two numbers, as nearly all lines of such files. This
  /// takes a tenth of the time of reading field by field.
  Result<void> readPairs() {
    for (;;) {
      VORPIPE_LET(lines, csv_.wholeLines());
      const char* const last = lines.data() + lines.size();
      const char* line = lines.data();
      std::uint64_t count = 0;
      RowProblem problem;
      while (line != last && !problem) {
        std::array<double, 2> pair{};
        const char* const end = pairIn(line, last, pair);
        if (end == nullptr) break;
        problem = table_.addRow(std::array{Point{pair[*columns_.x], pair[*columns_.y]}}, std::nullopt);
        line = end;
        ++count;
      }
      csv_.skip(static_cast<std::size_t>(line - lines.data()), count);
      if (problem) return csv_.errorAtLine(*problem);
      if (lines.empty() || line != last) {
        are_pairs_ = !lines.empty();
        return {};
      }
    }
  }

  /// Returns the end of a line that is two finite numbers with a comma between them; null if it is not.
  static const char* pairIn(const char* line, const char* last, std::array<double, 2>& pair) {
    const auto first = std::from_chars(line, last, pair[0]);
    if (first.ec != std::errc() || first.ptr == last || *first.ptr != ',') return nullptr;
    const auto second = std::from_chars(first.ptr + 1, last, pair[1]);
    if (second.ec != std::errc() || !std::isfinite(pair[0]) || !std::isfinite(pair[1])) return nullptr;
    const char* end = second.ptr;
    if (end != last && *end == '\r') ++end;
    return end != last && *end == '\n' ? end + 1 : nullptr;
  }

  [[nodiscard]] bool isNumber(std::size_t column) const {
    return column < csv_.fields() && numberIn(csv_.field(column)).has_value();
  }

  /// How many of the first four fields are numbers.
  [[nodiscard]] std::size_t leadingNumbers() const {
    constexpr std::size_t most = 4;
    std::size_t count = 0;
    while (count < most && isNumber(count)) ++count;
    return count;
  }

  /// A comma may be a decimal comma unless it separates fields.
  [[nodiscard]] tl::expected<Decimal, std::string> numberIn(std::string_view text) const {
    if (csv_.separator() != ',') return parseDecimal(text);
    return parseNumber(text).map([](double value) { return Decimal{value, DecimalMark::none}; });
  }

  [[nodiscard]] tl::unexpected<Error> wrong(std::size_t column, std::string_view what) const {
    return csv_.errorAt(column, fmt::format("{} (column {})", what, printable(names_[column])));
  }

  Result<double> number(std::size_t column) {
    const auto number = numberIn(csv_.field(column));
    if (!number) return wrong(column, number.error());
    if (number->mark != DecimalMark::none && number->mark != mark_) {
      if (mark_ != DecimalMark::none) {
        return wrong(
            column, fmt::format("{} has a decimal {}, and line {} a decimal {}", inQuotes(csv_.field(column)),
                                number->mark == DecimalMark::comma ? "comma" : "point", mark_line_,
                                mark_ == DecimalMark::comma ? "comma" : "point"));
      }
      mark_ = number->mark;
      mark_line_ = csv_.line();
    }
    return number->value;
  }

  /// The first of the columns that a site needs whose field has no value, if there is one.
  [[nodiscard]] std::optional<std::size_t> missingColumn() const {
    for (const auto& column : {columns_.x, columns_.y, columns_.z, columns_.geometry, columns_.weight}) {
      if (column && isMissingValue(csv_.field(*column))) return column;
    }
    return std::nullopt;
  }

  Result<void> readRow() {
    if (csv_.fields() != names_.size()) {
      return csv_.errorAt(std::min(csv_.fields(), names_.size()),
                          fmt::format("the row has {} field{}, the header {}", csv_.fields(),
                                      csv_.fields() == 1 ? "" : "s", names_.size()));
    }
    if (const auto missing = missingColumn()) {
      if (const auto problem = table_.addMissingValue(trimmed(csv_.field(*missing)))) {
        return wrong(*missing, *problem);
      }
      return {};
    }
    std::optional<double> weight;
    if (columns_.weight) {
      VORPIPE_LET(given, number(*columns_.weight));
      const auto valid = weightOf(columns_.weight_kind, given, csv_.field(*columns_.weight));
      if (!valid) return wrong(*columns_.weight, valid.error());
      weight = *valid;
    }
    return columns_.geometry ? addGeometry(weight) : addPoint(weight);
  }

  Result<void> addPoint(std::optional<double> weight) {
    VORPIPE_LET(x, number(*columns_.x));
    VORPIPE_LET(y, number(*columns_.y));
    if (!columns_.z) return add(std::array{Point{x, y}}, weight, *columns_.x);
    VORPIPE_LET(z, number(*columns_.z));
    return add(std::array{Point{x, y}}, weight, *columns_.x, z);
  }

  Result<void> addGeometry(std::optional<double> weight) {
    const std::size_t column = *columns_.geometry;
    WktTokens tokens(csv_.field(column));
    WktPoints taken;
    auto problem = takePoints(tokens, taken);
    if (!problem && !tokens.atEnd()) problem = tokens.expected("the end of the field");
    if (problem) return wrong(column, fmt::format("its WKT at {}", *problem));
    if (taken.others) table_.noteHeights();
    if (taken.system && *taken.system > 0) {
      if (table_.system().code != 0 && table_.system().code != *taken.system) {
        return wrong(column, fmt::format("is of SRID {}, and rows before it of {}", *taken.system,
                                         table_.system().code));
      }
      table_.system() = systemOfCode(*taken.system);
    }
    if (!taken.points.empty()) return add(taken.points, weight, column);
    if (const auto missing = table_.addMissing("has no place: it is EMPTY")) return wrong(column, *missing);
    return {};
  }

  Result<void> add(std::span<const Point> points, std::optional<double> weight, std::size_t column,
                   std::optional<double> z = {}) {
    if (table_.attributes().kept()) {
      for (const auto& [from, to] : attributes_) {
        if (csv_.field(from).empty()) continue;
        table_.attributes().set(to, AttributeType::text, text_.of(csv_, from));
      }
    }
    table_.setPlace([&] { return fmt::format("line {}", csv_.line()); });
    const auto problem = table_.addRow(points, weight, z);
    if (!problem) return {};
    return csv_.errorAt(table_.refusedNeeded() ? needed_ : column, *problem);
  }

  SiteTable finish() {
    if (csv_.comments() > 0) {
      table_.note(fmt::format("{} line{} begin{} with # and {} left out", csv_.comments(),
                              csv_.comments() == 1 ? "" : "s", csv_.comments() == 1 ? "s" : "",
                              csv_.comments() == 1 ? "is" : "are"));
    }
    if (text_.otherLine() > 0) {
      table_.note(fmt::format("line {} is not UTF-8: such text is taken as Windows-1252", text_.otherLine()));
    }
    SiteTable table = table_.finish();
    for (Attribute& attribute : table.attributes) {
      if (csv_.separator() != ',') attribute = withDecimalPoints(std::move(attribute), mark_);
      attribute.inferType();
    }
    return table;
  }

  struct AttributeOf {
    std::size_t from, to;  ///< columns of the file and of the attributes
  };

  CsvReader csv_;
  const ReadOptions& options_;
  TableBuilder table_;
  CsvColumns columns_{};
  std::vector<std::string> names_;
  std::vector<AttributeOf> attributes_;
  bool are_pairs_ = false;  ///< rows are x and y alone, and lines end with LF
  std::size_t needed_ = 0;  ///< the column of the needed attribute
  CsvText text_;
  DecimalMark mark_ = DecimalMark::none;  ///< of the numbers so far
  std::uint64_t mark_line_ = 0;
};

Result<SiteTable> readTable(InputFile file, const ReadOptions& options, std::optional<char> separator) {
  VORPIPE_VAR(csv, CsvReader::create(LineReader(std::move(file)), separator));
  return CsvSites(std::move(csv), options).read();
}

}  // namespace

Result<SiteTable> readCsvSites(InputFile file, const ReadOptions& options) {
  return readTable(std::move(file), options, std::nullopt);
}

Result<SiteTable> readTsvSites(InputFile file, const ReadOptions& options) {
  return readTable(std::move(file), options, '\t');
}

}  // namespace vorpipe
