#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "io/files/error.h"
#include "io/sites/sites_file.h"
#include "io/sites/sites_reader.h"
#include "io/text/csv_reader.h"
#include "io/text/number.h"

namespace vorpipe {
namespace {

/// Where the columns stand that are used.
struct Columns {
  std::size_t x, y;
  std::optional<std::size_t> weight, radius;
  std::size_t count;  ///< of all columns
};

std::string headerText(const CsvReader& csv) {
  std::string names;
  for (std::size_t i = 0; i < csv.fields(); ++i) {
    if (i > 0) names += ',';
    names += csv.field(i);
  }
  return quoted(names);
}

Result<Columns> readHeader(CsvReader& csv) {
  const auto header = csv.next();
  if (!header) {
    return tl::unexpected(header.error());
  }
  if (!*header) {
    return inputError(csv.name() + ": is empty; its first line must name the columns, as in \"x,y\"");
  }
  constexpr std::array<std::string_view, 4> names = {"x", "y", "weight", "radius"};
  std::array<std::optional<std::size_t>, 4> found;
  for (std::size_t i = 0; i < csv.fields(); ++i) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (csv.field(i) != names[k]) {
        continue;
      }
      if (found[k]) {
        return csv.errorAt(i, fmt::format("the header names column \"{}\" twice", names[k]));
      }
      found[k] = i;
    }
  }
  const auto [x, y, weight, radius] = found;
  if (!x || !y) {
    return csv.errorAt(0, fmt::format("the header {} names no column \"{}\"; the first line must name the "
                                      "columns, as in \"x,y\"",
                                      headerText(csv), !x ? "x" : "y"));
  }
  if (weight && radius) {
    return csv.errorAt(std::max(*weight, *radius),
                       "the header names both \"weight\" and \"radius\"; keep one");
  }
  return Columns{*x, *y, weight, radius, csv.fields()};
}

Result<double> readField(const CsvReader& csv, std::size_t column, std::string_view name) {
  const auto number = parseNumber(csv.field(column));
  if (!number) {
    return csv.errorAt(column, fmt::format("{} (column {})", number.error(), name));
  }
  return *number;
}

Result<double> readRadius(const CsvReader& csv, std::size_t column) {
  const auto radius = readField(csv, column, "radius");
  if (!radius) {
    return radius;
  }
  if (*radius < 0) {
    return csv.errorAt(column, quoted(csv.field(column)) + " is negative (column radius)");
  }
  const double weight = *radius * *radius;
  if (!std::isfinite(weight)) {
    return csv.errorAt(column, "the square of " + quoted(csv.field(column)) +
                                   " is out of the range of a double (column radius)");
  }
  return weight;
}

Result<void> readRow(const CsvReader& csv, const Columns& columns, Sites& sites) {
  if (csv.fields() != columns.count) {
    return csv.errorAt(std::min(csv.fields(), columns.count),
                       fmt::format("the row has {} field{}, the header {}", csv.fields(),
                                   csv.fields() == 1 ? "" : "s", columns.count));
  }
  if (sites.size() == max_sites) {
    return csv.errorAt(0, fmt::format("the file holds more than {} sites", max_sites));
  }
  const auto x = readField(csv, columns.x, "x");
  if (!x) {
    return tl::unexpected(x.error());
  }
  const auto y = readField(csv, columns.y, "y");
  if (!y) {
    return tl::unexpected(y.error());
  }
  if (columns.weight || columns.radius) {
    const auto weight =
        columns.weight ? readField(csv, *columns.weight, "weight") : readRadius(csv, *columns.radius);
    if (!weight) {
      return tl::unexpected(weight.error());
    }
    sites.weight.push_back(*weight);
  }
  sites.x.push_back(*x);
  sites.y.push_back(*y);
  return {};
}

}  // namespace

Result<Sites> readCsvSites(InputFile file) {
  auto csv = CsvReader::create(LineReader(std::move(file)));
  if (!csv) {
    return tl::unexpected(csv.error());
  }
  const auto columns = readHeader(*csv);
  if (!columns) {
    return tl::unexpected(columns.error());
  }
  Sites sites;
  while (true) {
    const auto more = csv->next();
    if (!more) {
      return tl::unexpected(more.error());
    }
    if (!*more) {
      return sites;
    }
    if (const auto row = readRow(*csv, *columns, sites); !row) {
      return tl::unexpected(row.error());
    }
  }
}

}  // namespace vorpipe
