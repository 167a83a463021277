#include <fmt/core.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
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

/// `columns` are those of x, y, in space z, and perhaps weight.
Result<void> readElements(InputFile& file, const NpyHeader& header, const std::vector<std::size_t>& columns,
                          Third third, SiteTable& table) {
  const auto names = namesOf(third);
  std::vector<std::vector<double>*> into = {&table.sites.x, &table.sites.y};
  if (third == Third::z) into.push_back(&table.z);
  into.push_back(&table.sites.weight);
  const std::uint64_t row_count = header.shape[0], column_count = header.shape[1];
  // For each column of the file: its index in names; their count if it is none.
  std::vector<std::size_t> use(column_count, names.size());
  for (std::size_t k = 0; k < columns.size(); ++k) use[columns[k]] = k;
  // Counts row and column: a division per element costs more than reading it.
  std::uint64_t row = 0, column = 0;
  const auto take = [&](std::uint64_t, auto number) -> Result<void> {
    const auto value = static_cast<double>(number);
    const std::size_t used = use[column];
    if (used < names.size() && !std::isfinite(value)) {
      return inputError(
          fmt::format("{}: element [{}, {}] (counted from 0; column {}) is {}, not a finite number",
                      file.name(), row, column, names[used], value));
    }
    if (used < names.size()) into[used]->push_back(value);
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

/// The columns of x, y, in space z, and perhaps weight. Without a choice, the shape determines them.
Result<std::vector<std::size_t>> columnsOf(const NpyHeader& header, const ReadOptions& options,
                                           const std::string& name) {
  const auto& shape = header.shape;
  const bool table = areNumbers(header) && shape.size() == 2 && shape[1] <= most_columns;
  if (!options.columns.empty() && table)
    return numberedColumns(options.columns, shape[1], name, options.third);
  const bool space = options.third == Third::z;
  const std::uint64_t places = space ? 3 : 2;
  if (!table || (shape[1] != places && shape[1] != places + 1)) {
    return inputError(fmt::format(
        "{}: holds {}; numbers (N, {}) or (N, {}), float32, float64 or whole ones, are needed{}{}", name,
        header.description, places, places + 1, space ? " in space" : "", table ? ", or --columns" : ""));
  }
  std::vector<std::size_t> columns(shape[1]);
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  return columns;
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
  VORPIPE_TRY(readElements(file, header, columns, options.third, table));
  if (options.columns.empty() && columns.size() == namesOf(options.third).size())
    table.notes.push_back(fmt::format("{}: {}", file.name(), lastIsWeight(options.third)));
  return table;
}

}  // namespace vorpipe
