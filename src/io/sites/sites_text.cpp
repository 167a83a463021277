#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "base/words.h"
#include "io/base/error.h"
#include "io/base/number.h"
#include "io/sites/simulation_cell.h"
#include "io/sites/sites_reader.h"
#include "io/sites/text_rows.h"

namespace vorpipe {
namespace {

/// Whether a field is a common spelling of a number that is not finite.
bool isNotFinite(std::string_view field) {
  const std::string word = lowerCase(field.substr(field.starts_with('-') || field.starts_with('+') ? 1 : 0));
  return word == "nan" || word == "inf" || word == "infinity";
}

/// Whether a row names columns: none of its fields is a number.
bool isHeader(std::span<const std::string_view> fields) {
  return fields.size() > 1 && std::ranges::none_of(fields, [](std::string_view field) {
           return field.empty() || parseNumber(field).has_value() || isNotFinite(field);
         });
}

/// Takes from the first row of numbers what applies to all.
Result<void> takeFirst(TextRows& rows) {
  const ReadOptions& options = rows.options();
  const std::size_t count = rows.fields().size();
  if (options.columns.empty()) {
    const auto names = namesOf(options.third);
    if (count + 1 < names.size() || count > names.size()) {
      return rows.lines().errorAt(
          1, fmt::format("the row has {} field{}; {} or {} is needed, or --columns", count,
                         count == 1 ? "" : "s", fmt::join(names.first(names.size() - 1), " "),
                         fmt::join(names, " ")));
    }
    if (count == names.size()) rows.table().note(lastIsWeight(options.third));
    std::vector<std::size_t> columns;
    for (std::size_t k = 0; k < count; ++k) columns.push_back(k);
    rows.takeColumns(std::move(columns), count);
    return {};
  }
  VORPIPE_VAR(columns, numberedColumns(options.columns, count, rows.lines().name(), options.third));
  rows.takeColumns(std::move(columns), count);
  // Columns left out by number need no note.
  for (std::size_t k = 0; k < count && options.attributes; ++k) {
    if (std::ranges::find(rows.columns(), k) == rows.columns().end())
      rows.takeAttribute(k, fmt::format("column_{}", k + 1));
  }
  return {};
}

/// Takes from the first row of a frame without names of columns what applies to all: an element, x, y, z and
/// perhaps more.
Result<void> takeFirstOfFrame(TextRows& rows) {
  constexpr std::size_t fewest = 4;
  const std::size_t count = rows.fields().size();
  const bool chosen = !rows.options().columns.empty();
  if (count < fewest || chosen) {
    return rows.lines().errorAt(
        1, chosen ? "of a file of elements and positions no columns are chosen"
                  : fmt::format("the row has {} fields; an element, x, y and z are needed", count));
  }
  rows.takeColumns({1, 2, 3}, count);
  rows.takeAttribute(0, "element");
  for (std::size_t k = fewest; k < count; ++k) rows.takeAttribute(k, fmt::format("column_{}", k + 1));
  return {};
}

/// Reads what follows the number of sites of an .xyz.
Result<SiteTable> readFrame(TextRows& rows, std::uint64_t count) {
  VORPIPE_LET(comment, rows.lines().next());
  VORPIPE_VAR(frame, readFrameComment(rows.lines(), comment.value_or("")));
  if (!frame.names.empty()) {
    VORPIPE_TRY(rows.takeNames(frame.names, frame.names_at));
  } else if (count > 0) {
    VORPIPE_LET(there, rows.next());
    if (!there) return inputError(fmt::format("{}: ends after 0 of {} sites", rows.lines().name(), count));
    VORPIPE_TRY(takeFirstOfFrame(rows));
    VORPIPE_TRY(rows.take());
    --count;
  }
  VORPIPE_TRY(rows.takeRows(count, frame.names.empty() ? 1 : 0));
  SiteTable table = rows.finish();
  table.cell = frame.cell;
  return table;
}

Result<SiteTable> readPlain(TextRows& rows) {
  VORPIPE_LET(there, rows.next());
  if (!there) return rows.finish();
  const auto fields = rows.fields();
  if (rows.options().third == Third::z && fields.size() == 1) {
    if (const auto count = wholeNumber<std::uint64_t>(fields[0])) return readFrame(rows, *count);
  }
  if (isHeader(fields)) {
    VORPIPE_TRY(rows.takeNames(std::vector<std::string>(fields.begin(), fields.end())));
  } else {
    VORPIPE_TRY(takeFirst(rows));
    VORPIPE_TRY(rows.take());
  }
  while (true) {
    VORPIPE_LET(more, rows.next());
    if (!more) return rows.finish();
    VORPIPE_TRY(rows.take());
  }
}

}  // namespace

Result<SiteTable> readTextSites(InputFile file, const ReadOptions& options) {
  TextRows rows(std::move(file), options);
  return readPlain(rows);
}

Result<SiteTable> readExtendedXyz(InputFile file, const ReadOptions& options) {
  TextRows rows(std::move(file), options);
  VORPIPE_LET(there, rows.next());
  if (!there) return rows.finish();
  const auto count = rows.fields().size() == 1 ? wholeNumber<std::uint64_t>(rows.fields()[0]) : std::nullopt;
  if (!count) return rows.lines().errorAt(1, "the first line of an extended xyz is the number of its sites");
  return readFrame(rows, *count);
}

Result<SiteTable> readVoroSites(InputFile file, const ReadOptions& options) {
  TextRows rows(std::move(file), options);
  VORPIPE_LET(there, rows.next());
  if (!there) return rows.finish();
  const std::vector<std::string> names{"id", "x", "y", "z", "radius"};
  const std::size_t count = rows.fields().size();
  if (count != names.size() && count + 1 != names.size()) {
    return rows.lines().errorAt(1, fmt::format("the row has {} field{}; Voro++ reads id x y z, or id x y z r",
                                               count, count == 1 ? "" : "s"));
  }
  VORPIPE_TRY(rows.takeNames(std::span(names).first(count)));
  while (true) {
    VORPIPE_TRY(rows.take());
    VORPIPE_LET(more, rows.next());
    if (!more) return rows.finish();
  }
}

}  // namespace vorpipe
