#include "io/sites/site_columns.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/try.h"
#include "base/words.h"
#include "io/base/error.h"
#include "io/base/number.h"
#include "io/base/quoted.h"

namespace vorpipe {
namespace {

using Found = tl::expected<CsvColumns, ColumnProblem>;
using Column = std::optional<std::size_t>;

struct Synonym {
  std::string_view name;
  CoordinateKind kind;
};

constexpr auto of_plane = CoordinateKind::plane, of_degrees = CoordinateKind::degrees;
constexpr std::array<Synonym, 6> x_names = {{{"x", CoordinateKind::unknown},
                                             {"lon", of_degrees},
                                             {"lng", of_degrees},
                                             {"long", of_degrees},
                                             {"longitude", of_degrees},
                                             {"easting", of_plane}}};
constexpr std::array<Synonym, 4> y_names = {
    {{"y", CoordinateKind::unknown}, {"lat", of_degrees}, {"latitude", of_degrees}, {"northing", of_plane}}};
constexpr std::array<std::string_view, 4> geometry_names = {"wkt", "geometry", "geom", "the_geom"};

tl::unexpected<ColumnProblem> problem(std::size_t column, std::string what) {
  return tl::unexpected(ColumnProblem{column, std::move(what)});
}

const Synonym* synonymOf(std::string_view name, std::span<const Synonym> synonyms) {
  const std::string lower = lowerCase(name);
  const auto found = std::ranges::find(synonyms, lower, &Synonym::name);
  return found == synonyms.end() ? nullptr : &*found;
}

bool isGeometry(const std::string& name) {
  return std::ranges::find(geometry_names, lowerCase(name)) != geometry_names.end();
}

/// Returns the only column for which `is` holds.
template <class Is>
tl::expected<Column, ColumnProblem> onlyColumn(std::span<const std::string> names, const Is& is) {
  Column found;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!is(names[k])) continue;
    if (found && names[*found] == names[k]) {
      return problem(k, fmt::format("the header names column {} twice", inQuotes(names[k])));
    }
    if (found) {
      return problem(k, fmt::format("the header names both {} and {}; --columns says which",
                                    inQuotes(names[*found]), inQuotes(names[k])));
    }
    found = k;
  }
  return found;
}

tl::expected<Column, ColumnProblem> exactly(std::span<const std::string> names, std::string_view name) {
  return onlyColumn(names, [name](const std::string& other) { return other == name; });
}

std::string headerText(std::span<const std::string> names) {
  return inQuotes(fmt::format("{}", fmt::join(names, ",")));
}

/// Returns a column by number or name; an exact match precedes one in another case.
tl::expected<std::size_t, ColumnProblem> chosenColumn(std::span<const std::string> names,
                                                      const std::string& text) {
  if (const auto number = wholeNumber<std::size_t>(text)) {
    if (*number >= 1 && *number <= names.size()) return *number - 1;
    return problem(0, fmt::format("there is no column {}; there are {}", text, names.size()));
  }
  auto found = exactly(names, text);
  if (!found) return tl::unexpected(found.error());
  if (!*found) {
    found = onlyColumn(names, [&](const std::string& name) { return lowerCase(name) == lowerCase(text); });
    if (!found) return tl::unexpected(found.error());
  }
  if (*found) return **found;
  return problem(0, fmt::format("the header {} names no column {}", headerText(names), inQuotes(text)));
}

/// Returns the kind that the names of both columns imply.
CoordinateKind kindOf(std::span<const std::string> names, std::size_t x, std::size_t y) {
  const Synonym* const of_x = synonymOf(names[x], x_names);
  const Synonym* const of_y = synonymOf(names[y], y_names);
  const bool one = of_x != nullptr && of_y != nullptr && of_x->kind == of_y->kind;
  return one ? of_x->kind : CoordinateKind::unknown;
}

/// Finds x, y, in space z, and possibly a weight; or a single column of WKT.
Found chosenColumns(std::span<const std::string> names, std::span<const std::string> chosen, Third third) {
  std::vector<std::size_t> found;
  for (const std::string& text : chosen) {
    VORPIPE_LET(column, chosenColumn(names, text));
    if (std::ranges::find(found, column) != found.end()) {
      return problem(column, fmt::format("column {} is chosen twice", inQuotes(names[column])));
    }
    found.push_back(column);
  }
  CsvColumns columns;
  const bool space = third == Third::z;
  const std::size_t places = space ? 3 : 2;
  if (found.size() == 1 && !space) {
    columns.geometry = found[0];
    return columns;
  }
  if (found.size() < places)
    return problem(0, fmt::format("{} columns are chosen; x, y and z are 3", found.size()));
  if (found.size() > places + 1) {
    return problem(0, fmt::format("{} columns are chosen; {} and a weight are {}", found.size(),
                                  space ? "x, y, z" : "x, y", places + 1));
  }
  columns.x = found[0];
  columns.y = found[1];
  if (space) columns.z = found[2];
  columns.kind = space ? of_plane : kindOf(names, found[0], found[1]);
  if (found.size() == places) return columns;
  const std::size_t weight = found[places];
  columns.weight = weight;
  columns.weight_kind = weightNamed(names[weight], true).value_or(WeightKind::weight);
  if (columns.weight_kind == WeightKind::radius) {
    columns.note =
        fmt::format("column {} is taken as {}", inQuotes(names[weight]), meaningOf(columns.weight_kind));
  }
  return columns;
}

/// Finds the column of weights, if the header names one.
tl::expected<void, ColumnProblem> findWeight(std::span<const std::string> names, CsvColumns& columns) {
  VORPIPE_LET(weight,
              onlyColumn(names, [](const std::string& name) { return weightNamed(name, true).has_value(); }));
  columns.weight = weight;
  if (weight) columns.weight_kind = *weightNamed(names[*weight], true);
  return {};
}

/// Finds the columns of x and y by the header, or that of WKT.
tl::expected<void, ColumnProblem> findPositions(std::span<const std::string> names, CsvColumns& columns) {
  auto x = exactly(names, "x");
  auto y = exactly(names, "y");
  if (x && y && (!*x || !*y)) {
    x = onlyColumn(names, [](const std::string& name) { return synonymOf(name, x_names) != nullptr; });
    y = onlyColumn(names, [](const std::string& name) { return synonymOf(name, y_names) != nullptr; });
  }
  if (!x) return tl::unexpected(x.error());
  if (!y) return tl::unexpected(y.error());
  if (*x && *y) {
    columns.x = *x;
    columns.y = *y;
    columns.kind = kindOf(names, **x, **y);
    return {};
  }
  VORPIPE_LET(geometry, onlyColumn(names, isGeometry));
  columns.geometry = geometry;
  if (geometry) return {};
  return problem(0,
                 fmt::format("the header {} names no column \"{}\"; the first line must name the columns, as "
                             "in \"x,y\", or --columns says which they are",
                             headerText(names), !*x ? "x" : "y"));
}

/// Finds x, y and z by the header.
Found columnsInSpace(std::span<const std::string> names) {
  CsvColumns columns;
  columns.kind = of_plane;
  for (const auto& [name, column] : {std::pair("x", &columns.x), {"y", &columns.y}, {"z", &columns.z}}) {
    VORPIPE_VAR(found, exactly(names, name));
    if (!found) {
      VORPIPE_LET(other, onlyColumn(names, [&](const std::string& of) { return lowerCase(of) == name; }));
      found = other;
    }
    *column = found;
    if (found) continue;
    return problem(0,
                   fmt::format("the header {} names no column \"{}\"; the first line must name the columns, "
                               "as in \"x,y,z\", or --columns says which they are",
                               headerText(names), name));
  }
  return columns;
}

/// Notes the columns with other names that are taken for x, y, weight or radius.
std::string noteOf(std::span<const std::string> names, const CsvColumns& columns) {
  std::vector<std::string> called, meaning;
  const auto add = [&](std::size_t column, std::string_view is) {
    called.push_back(inQuotes(names[column]));
    meaning.emplace_back(is);
  };
  if (columns.x && lowerCase(names[*columns.x]) != "x") add(*columns.x, "x");
  if (columns.y && lowerCase(names[*columns.y]) != "y") add(*columns.y, "y");
  if (columns.geometry) add(*columns.geometry, "points in WKT");
  const bool radius = columns.weight_kind == WeightKind::radius;
  if (columns.weight && names[*columns.weight] != (radius ? "radius" : "weight")) {
    add(*columns.weight, meaningOf(columns.weight_kind));
  }
  if (called.empty()) return {};
  return fmt::format("{} {} taken as {}; --columns names others", fmt::join(called, ", "),
                     called.size() == 1 ? "is" : "are", fmt::join(meaning, ", "));
}

}  // namespace

std::optional<WeightKind> weightNamed(std::string_view name, bool letters) {
  const std::string lower = lowerCase(name);
  if (lower == "weight" || (letters && lower == "w")) return WeightKind::weight;
  if (lower == "radius" || (letters && lower == "r")) return WeightKind::radius;
  return std::nullopt;
}

tl::expected<double, std::string> weightOf(WeightKind kind, double number, std::string_view text) {
  if (kind == WeightKind::weight) return number;
  if (number < 0) return tl::unexpected(inQuotes(text) + " is negative, and a radius");
  if (std::isfinite(number * number)) return number * number;
  return tl::unexpected("the square of " + inQuotes(text) + " is out of the range of a double");
}

Found namedColumns(std::span<const std::string> names, std::span<const std::string> chosen, Third third) {
  if (!chosen.empty()) return chosenColumns(names, chosen, third);
  CsvColumns columns;
  if (third == Third::z) {
    VORPIPE_LET(found, columnsInSpace(names));
    columns = found;
  } else {
    VORPIPE_TRY(findPositions(names, columns));
  }
  VORPIPE_TRY(findWeight(names, columns));
  columns.note = noteOf(names, columns);
  return columns;
}

bool anyKnownColumn(std::span<const std::string> names) {
  return std::ranges::any_of(names, [](const std::string& name) {
    return synonymOf(name, x_names) != nullptr || synonymOf(name, y_names) != nullptr || isGeometry(name) ||
           weightNamed(name, true);
  });
}

Found unnamedColumns(std::size_t count, std::size_t numbers, std::span<const std::string> chosen,
                     Third third) {
  const std::vector<std::string> none(count);
  if (!chosen.empty()) return chosenColumns(none, chosen, third);
  CsvColumns columns;
  columns.x = 0;
  columns.y = 1;
  if (third == Third::z) {
    if (numbers < 3) return problem(count < 3 ? 0 : 2, "the row has no x, y and z");
    columns.z = 2;
    columns.kind = of_plane;
    columns.note = "there is no header: columns 1, 2 and 3 are taken as x, y and z";
    if (count != 4 || numbers < 4) return columns;
    columns.weight = 3;
    columns.note =
        "there is no header: columns 1 to 4 are taken as x, y, z and weights; --columns 1,2,3 leaves 4 out";
    return columns;
  }
  columns.note = "there is no header: columns 1 and 2 are taken as x and y";
  if (count == 3 && numbers == 3) {
    columns.weight = 2;
    columns.note =
        "there is no header: columns 1, 2 and 3 are taken as x, y and weights; --columns 1,2 leaves 3 out";
  }
  return columns;
}

std::optional<std::pair<std::size_t, std::size_t>> positionsWithoutHeader(
    std::span<const std::string> chosen) {
  if (chosen.empty()) return std::pair<std::size_t, std::size_t>(0, 1);
  if (chosen.size() == 1) return std::nullopt;
  const auto x = wholeNumber<std::size_t>(chosen[0]), y = wholeNumber<std::size_t>(chosen[1]);
  if (!x || !y || *x < 1 || *y < 1) return std::nullopt;
  return std::pair(*x - 1, *y - 1);
}

Result<std::vector<std::size_t>> numberedColumns(std::span<const std::string> columns, std::size_t count,
                                                 std::string_view name, Third third) {
  std::vector<std::size_t> chosen;
  for (const std::string& column : columns) {
    const auto number = wholeNumber<std::size_t>(column);
    if (!number) {
      return inputError(fmt::format("{}: its columns have no names, as {}; they have numbers from 1", name,
                                    inQuotes(column)));
    }
    if (*number < 1 || *number > count) {
      return inputError(fmt::format("{}: has no column {}; it has {}", name, column, count));
    }
    if (std::ranges::find(chosen, *number - 1) != chosen.end()) {
      return inputError(fmt::format("{}: column {} is named twice", name, column));
    }
    chosen.push_back(*number - 1);
  }
  if (third == Third::z) {
    if (chosen.size() == 3 || chosen.size() == 4) return chosen;
    return inputError(fmt::format(
        "{}: the columns of x, y, z and perhaps weights are needed, as in 1,2,3 or 1,2,3,4", name));
  }
  if (chosen.size() == 2 || chosen.size() == 3) return chosen;
  return inputError(fmt::format("{}: two or three columns are needed, as in 1,2 or 1,2,3", name));
}

}  // namespace vorpipe
