/// Which columns of a table hold sites, and which names mean weights.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/coordinate_system.h"
#include "io/sites/sites_file.h"
#include "vorpipe.h"

namespace vorpipe {

enum class WeightKind : std::uint8_t {
  weight,
  radius,  ///< its square is the weight
};

/// Name of a kind in messages.
constexpr std::string_view meaningOf(WeightKind kind) {
  return kind == WeightKind::weight ? "weight" : "radius, whose square is the weight";
}

/// Returns the kind that "weight" or "radius", in any case, names; also w and r if `letters` is set.
std::optional<WeightKind> weightNamed(std::string_view name, bool letters);

/// Returns the weight that a number stands for. The error states what is wrong with it, quoting `text`: a
/// radius is negative, or its square is no double.
tl::expected<double, std::string> weightOf(WeightKind kind, double number, std::string_view text);

struct CsvColumns {
  std::optional<std::size_t> x, y;      ///< both or none
  std::optional<std::size_t> geometry;  ///< of WKT; if there is no x and y
  std::optional<std::size_t> z;         ///< in space
  std::optional<std::size_t> weight;
  WeightKind weight_kind = WeightKind::weight;
  CoordinateKind kind = CoordinateKind::unknown;  ///< as their names imply
  std::string note;                               ///< what was reinterpreted; empty: nothing
  [[nodiscard]] bool has(std::size_t column) const {
    return x == column || y == column || z == column || geometry == column || weight == column;
  }
};

/// Why columns cannot be determined.
struct ColumnProblem {
  std::size_t column;  ///< which the error is about
  std::string what;
};

/// Returns the columns that a header names: x and y; else longitude and latitude or easting and northing, or
/// a column of WKT, by their usual names in any case. In space, x, y and z. `chosen` are the columns named by
/// --columns, used instead.
tl::expected<CsvColumns, ColumnProblem> namedColumns(std::span<const std::string> names,
                                                     std::span<const std::string> chosen,
                                                     Third third = Third::weight);

/// Whether any of the names identifies what its column holds: a coordinate, geometries or a weight.
bool anyKnownColumn(std::span<const std::string> names);

/// Returns the columns of a table without a header, by their number and how many of the first begin with a
/// number.
tl::expected<CsvColumns, ColumnProblem> unnamedColumns(std::size_t count, std::size_t numbers,
                                                       std::span<const std::string> chosen,
                                                       Third third = Third::weight);

/// Returns the two columns of x and y if there is no header; none if `chosen` has names.
std::optional<std::pair<std::size_t, std::size_t>> positionsWithoutHeader(
    std::span<const std::string> chosen);

/// Returns the unnamed columns of x, y, in space z, and possibly weights, from 0. Errors (input),
/// beginning with `name`: an entry of `columns` is no number from 1 to `count`, or two are the same.
Result<std::vector<std::size_t>> numberedColumns(std::span<const std::string> columns, std::size_t count,
                                                 std::string_view name, Third third = Third::weight);

}  // namespace vorpipe
