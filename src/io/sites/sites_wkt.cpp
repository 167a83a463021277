#include <fmt/core.h>

#include <utility>

#include "io/files/error.h"
#include "io/sites/sites_reader.h"
#include "io/sites/table_builder.h"
#include "io/sites/wkt_points.h"
#include "io/text/line_reader.h"

namespace vorpipe {
namespace {

/// All geometries of a text, each a row.
WktProblem takeAll(std::string_view text, TableBuilder& table) {
  WktTokens tokens(text);
  std::optional<std::int64_t> system;
  while (!tokens.atEnd()) {
    const WktTokens begin = tokens;
    WktPoints taken;
    if (auto problem = takePoints(tokens, taken)) return problem;
    if (taken.others) table.noteHeights();
    if (taken.system && system && taken.system != system) {
      return begin.wrong(fmt::format("is of SRID {}, and those before it of {}", *taken.system, *system));
    }
    if (taken.system) system = taken.system;
    const auto problem = taken.points.empty() ? table.addMissing("has no place: it is EMPTY")
                                              : table.addRow(taken.points, std::nullopt);
    if (problem) return begin.wrong(*problem);
  }
  if (system && *system > 0) table.system() = systemOfCode(*system);
  return {};
}

}  // namespace

Result<SiteTable> readWktSites(InputFile file, const ReadOptions& options) {
  const auto text = readText(file);
  if (!text) return tl::unexpected(text.error());
  TableBuilder table(file.name(), options);
  if (const auto problem = takeAll(withoutByteOrderMark(*text), table)) {
    return inputError(fmt::format("{}:{}", file.name(), *problem));
  }
  return table.finish();
}

}  // namespace vorpipe
