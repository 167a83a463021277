/// Which columns of a table hold sites.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/coordinate_system.h"
#include "io/sites/weight_name.h"
#include "vorpipe.h"

namespace vorpipe {

struct CsvColumns {
  std::optional<std::size_t> x, y;      ///< both or none
  std::optional<std::size_t> geometry;  ///< of WKT; where there is no x and y
  std::optional<std::size_t> weight;
  WeightKind weight_kind = WeightKind::weight;
  CoordinateKind kind = CoordinateKind::unknown;  ///< as their names tell
  std::string note;                               ///< what was reinterpreted; empty: nothing
  [[nodiscard]] bool has(std::size_t column) const {
    return x == column || y == column || geometry == column || weight == column;
  }
};

/// Why columns cannot be told.
struct ColumnProblem {
  std::size_t column;  ///< which the error is about
  std::string what;
};

/// The columns that a header's names tell: x and y; else longitude and latitude or easting and northing, or a
/// column of WKT, by their usual names in any case. `chosen` are those that --columns names, instead.
tl::expected<CsvColumns, ColumnProblem> namedColumns(std::span<const std::string> names,
                                                     std::span<const std::string> chosen);

/// Whether one of the names alone says what its column holds: a coordinate, geometries or a weight.
bool sayColumns(std::span<const std::string> names);

/// Those of a table without a header, by the number of its columns, and whether the third begins with a
/// number.
tl::expected<CsvColumns, ColumnProblem> unnamedColumns(std::size_t count, bool third_is_number,
                                                       std::span<const std::string> chosen);

/// Which two columns hold x and y, if there is no header; none where those that are chosen have names.
std::optional<std::pair<std::size_t, std::size_t>> placesWithoutHeader(std::span<const std::string> chosen);

}  // namespace vorpipe
