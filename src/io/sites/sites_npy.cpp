#include <fmt/core.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/input_file.h"
#include "io/base/npy_array.h"
#include "io/sites/site_columns.h"
#include "io/sites/sites_file.h"
#include "io/sites/sites_reader.h"

namespace vorpipe {
namespace {

constexpr std::uint64_t most_columns = 1 << 20;

/// `columns` are those of x, y and perhaps weight.
Result<void> readElements(InputFile& file, const NpyHeader& header, const std::vector<std::size_t>& columns,
                          std::span<const std::string_view> names, Sites& sites) {
  // In space z takes the place of weights.
  const std::array<std::vector<double>*, 3> into = {&sites.x, &sites.y, &sites.weight};
  const std::uint64_t row_count = header.shape[0], column_count = header.shape[1];
  // For each column of the file: its index in site_numbers; their count if it is none.
  std::vector<std::size_t> use(column_count, site_numbers.size());
  for (std::size_t k = 0; k < columns.size(); ++k) use[columns[k]] = k;
  // Counts row and column: a division per element costs more than reading it.
  std::uint64_t row = 0, column = 0;
  const auto take = [&](std::uint64_t, auto number) -> Result<void> {
    const auto value = static_cast<double>(number);
    const std::size_t used = use[column];
    if (used < site_numbers.size() && !std::isfinite(value)) {
      return inputError(
          fmt::format("{}: element [{}, {}] (counted from 0; column {}) is {}, not a finite number",
                      file.name(), row, column, names[used], value));
    }
    if (used < site_numbers.size()) into[used]->push_back(value);
    std::uint64_t& inner = header.fortran_order ? row : column;
    std::uint64_t& outer = header.fortran_order ? column : row;
    if (++inner == (header.fortran_order ? row_count : column_count)) {
      inner = 0;
      ++outer;
    }
    return {};
  };
  return eachNumber(file, header, row_count * column_count, take);
}

/// The columns of x, y and perhaps weight. Without a choice, the shape determines them.
Result<std::vector<std::size_t>> columnsOf(const NpyHeader& header, const ReadOptions& options,
                                           const std::string& name) {
  const auto& shape = header.shape;
  const bool table = areNumbers(header) && shape.size() == 2 && shape[1] <= most_columns;
  if (!options.columns.empty() && table)
    return numberedColumns(options.columns, shape[1], name, options.third);
  if (options.third == Third::z && !(table && shape[1] == 3)) {
    return inputError(
        fmt::format("{}: holds {}; numbers (N, 3), float32, float64 or whole ones, are needed "
                    "in space{}{}",
                    name, header.description, table ? ", or --columns" : "",
                    table && shape[1] == 4 ? " 1,2,3: the fourth would be weights, which cells "
                                             "in space do not have"
                                           : ""));
  }
  if (!table || (shape[1] != 2 && shape[1] != 3)) {
    return inputError(
        fmt::format("{}: holds {}; numbers (N, 2) or (N, 3), float32, float64 or whole ones, are needed{}",
                    name, header.description, table ? ", or --columns" : ""));
  }
  return shape[1] == 2 ? std::vector<std::size_t>{0, 1} : std::vector<std::size_t>{0, 1, 2};
}

}  // namespace

Result<SiteTable> readNpySites(InputFile file, const ReadOptions& options) {
  VORPIPE_LET(header, readNpyHeader(file));
  VORPIPE_LET(columns, columnsOf(header, options, file.name()));
  if (header.shape[0] > max_sites) {
    return inputError(fmt::format("{}: holds more than {} sites", file.name(), max_sites));
  }
  const auto what = fmt::format("{} sites", header.shape[0]);
  const auto room = checkRoom(file.name(), what, header.shape[0] * columns.size() * sizeof(double));
  if (!room) return tl::unexpected(room.error());
  SiteTable table;
  VORPIPE_TRY(readElements(file, header, columns, namesOf(options.third), table.sites));
  if (options.third == Third::weight && options.columns.empty() && columns.size() == site_numbers.size()) {
    table.notes.push_back(fmt::format("{}: {}", file.name(), third_is_weight));
  }
  return table;
}

}  // namespace vorpipe
