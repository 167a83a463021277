#include <fmt/core.h>

#include <utility>

#include "io/base/error.h"
#include "io/base/line_reader.h"
#include "io/sites/sites_reader.h"
#include "io/sites/table_builder.h"

namespace vorpipe {
namespace {

/// Takes all geometries, each as a row.
WktProblem takeAll(WktTokens& tokens, TableBuilder& table) {
  std::optional<std::int64_t> system;
  while (!tokens.atEnd()) {
    const WktPlace begin = tokens.place();
    WktPoints taken;
    if (auto problem = takePoints(tokens, taken)) return problem;
    if (taken.others) table.noteHeights();
    if (taken.system && system && taken.system != system) {
      return wrongAt(begin, fmt::format("is of SRID {}, and those before it of {}", *taken.system, *system));
    }
    if (taken.system) system = taken.system;
    const auto problem = taken.points.empty() ? table.addMissing("has no place: it is EMPTY")
                                              : table.addRow(taken.points, std::nullopt);
    if (problem) return wrongAt(begin, *problem);
  }
  if (system && *system > 0) table.system() = systemOfCode(*system);
  return {};
}

}  // namespace

WktProblem takePoints(WktTokens& tokens, WktPoints& taken) {
  if (auto problem = tokens.takeSystem(taken.system)) return problem;
  const bool several = tokens.takeType("MULTIPOINT");
  if (!several && !tokens.takeType("POINT")) return tokens.expected("POINT or MULTIPOINT");
  const auto position = [&] { return tokens.takePosition(taken.points.emplace_back(), taken.others); };
  if (!several) {
    auto problem = tokens.takeList(position);
    if (!problem && taken.points.size() > 1)
      return tokens.wrong("a POINT of several positions ends before this");
    return problem;
  }
  // Each point may have parentheses of its own: (1 2, 3 4), ((1 2), (3 4)).
  const auto point = [&] {
    const std::size_t before = taken.points.size();
    auto problem = tokens.is("(") || tokens.is("EMPTY") ? tokens.takeList(position) : position();
    if (!problem && taken.points.size() > before + 1)
      return WktProblem(tokens.wrong("a point of several positions ends before this"));
    return problem;
  };
  return tokens.takeList(point);
}

Result<SiteTable> readWktSites(InputFile file, const ReadOptions& options) {
  TableBuilder table(file.name(), options);
  WktTokens tokens(file);
  if (const auto problem = takeAll(tokens, table)) return tokens.refused(*problem);
  return tokens.end().map([&] { return table.finish(); });
}

}  // namespace vorpipe
