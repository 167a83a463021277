#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "io/files/error.h"
#include "io/sites/sites_file.h"
#include "io/sites/sites_reader.h"
#include "io/text/line_reader.h"
#include "io/text/number.h"

namespace vorpipe {
namespace {

constexpr std::size_t max_fields = 3;
constexpr std::array<std::string_view, max_fields> names = {"x", "y", "weight"};

struct Row {
  std::size_t count = 0;  ///< of fields, those beyond max_fields included
  std::array<std::string_view, max_fields> field{};
};

/// Fields are separated by blanks or by one comma with blanks around it: "1, ,2" has an empty field.
Row split(std::string_view line) {
  Row row;
  line = trimmed(line.substr(0, line.find('#')));
  if (line.empty()) {
    return row;
  }
  while (true) {
    const std::size_t end = std::min(line.find_first_of(" \t,"), line.size());
    if (row.count < max_fields) {
      row.field[row.count] = line.substr(0, end);
    }
    ++row.count;
    line.remove_prefix(end);
    if (line.empty()) {
      return row;
    }
    line = trimmed(line);
    if (line.starts_with(',')) {
      line = trimmed(line.substr(1));
    }
  }
}

/// `columns` is 0 before the first row and then the number of fields that every row has.
Result<void> readRow(const LineReader& lines, std::string_view line, std::size_t& columns, Sites& sites) {
  const Row row = split(line);
  if (row.count == 0) {
    return {};
  }
  if (row.count < 2 || row.count > max_fields) {
    return lines.errorAt(1, fmt::format("the row has {} field{}; x y or x y weight is needed", row.count,
                                        row.count == 1 ? "" : "s"));
  }
  if (columns != 0 && row.count != columns) {
    return lines.errorAt(1, fmt::format("the row has {} fields, the rows before it {}", row.count, columns));
  }
  if (sites.size() == max_sites) {
    return lines.errorAt(1, fmt::format("the file holds more than {} sites", max_sites));
  }
  columns = row.count;
  std::array<double, max_fields> value{};
  for (std::size_t i = 0; i < columns; ++i) {
    const auto number = parseNumber(row.field[i]);
    if (!number) {
      const auto column = static_cast<std::size_t>(row.field[i].data() - line.data()) + 1;
      return lines.errorAt(column, fmt::format("{} (column {})", number.error(), names[i]));
    }
    value[i] = *number;
  }
  sites.x.push_back(value[0]);
  sites.y.push_back(value[1]);
  if (columns == max_fields) {
    sites.weight.push_back(value[2]);
  }
  return {};
}

}  // namespace

Result<Sites> readTextSites(InputFile file) {
  LineReader lines(std::move(file));
  Sites sites;
  std::size_t columns = 0;
  while (true) {
    const auto line = lines.next();
    if (!line) {
      return tl::unexpected(line.error());
    }
    if (!*line) {
      return sites;
    }
    if (const auto row = readRow(lines, **line, columns, sites); !row) {
      return tl::unexpected(row.error());
    }
  }
}

}  // namespace vorpipe
