#include <fmt/core.h>

#include <utility>

#include "io/base/error.h"
#include "io/base/line_reader.h"
#include "io/sites/sites_reader.h"
#include "io/sites/table_builder.h"
#include "io/sites/wkt_points.h"

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

Result<SiteTable> readWktSites(InputFile file, const ReadOptions& options) {
  TableBuilder table(file.name(), options);
  WktTokens tokens(file);
  if (const auto problem = takeAll(tokens, table)) {
    return tokens.refused(*problem);
  }
  return tokens.end().map([&] { return table.finish(); });
}

}  // namespace vorpipe
