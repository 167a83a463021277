#include "cli/cells_difference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/zip_file.h"
#include "io/cells/read_npz_cells.h"

namespace vorpipe::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Counts of sites that differ, in the plane and in space.
struct Counts {
  std::uint64_t equal, statuses, neighbors, measures;
  std::string_view measure;  ///< "areas", "volumes"
  std::vector<std::uint32_t> first;
};

CellsDifference differenceOf(const Counts& counts) {
  CellsDifference difference;
  difference.found = {{"equal", counts.equal},
                      {"statuses", counts.statuses},
                      {"neighbors", counts.neighbors},
                      {std::string(counts.measure), counts.measures},
                      {"first", counts.first}};
  difference.agreement = fmt::format("{} cells equal", counts.equal);
  if (!counts.first.empty()) {
    difference.difference = fmt::format(
        "of the cells {} are equal, {} statuses, {} lists of neighbors and {} {} differ, first at "
        "site{} {}",
        counts.equal, counts.statuses, counts.neighbors, counts.measures, counts.measure,
        counts.first.size() == 1 ? "" : "s", fmt::join(counts.first, ", "));
  }
  return difference;
}

template <class Diagrams>
Result<Diagrams> sameNumber(Diagrams diagrams, const std::string& a, const std::string& b) {
  if (diagrams.first.size() == diagrams.second.size()) return diagrams;
  return inputError(
      fmt::format("{} and {}: have {} and {} sites", a, b, diagrams.first.size(), diagrams.second.size()));
}

}  // namespace

Result<CellsDifference> compareCellsFiles(const std::string& a, const std::string& b) {
  VORPIPE_LET(file_a, NpzFile::read(a));
  VORPIPE_LET(file_b, NpzFile::read(b));
  const bool space = hasSpaceCells(file_a);
  if (space != hasSpaceCells(file_b)) {
    return inputError(fmt::format("{} has cells in {}, {} in {}", a, space ? "space" : "the plane", b,
                                  space ? "the plane" : "space"));
  }
  if (space) {
    VORPIPE_VAR(cells_a, readSpaceCells(file_a));
    VORPIPE_VAR(cells_b, readSpaceCells(file_b));
    VORPIPE_LET(both, sameNumber(std::pair(std::move(cells_a), std::move(cells_b)), a, b));
    VORPIPE_VAR(diff, diffCells(both.first, both.second));
    return differenceOf(
        {diff.equal, diff.statuses, diff.neighbors, diff.volumes, "volumes", std::move(diff.first)});
  }
  VORPIPE_VAR(cells_a, readNpzCells(file_a));
  VORPIPE_VAR(cells_b, readNpzCells(file_b));
  VORPIPE_LET(both, sameNumber(std::pair(std::move(cells_a), std::move(cells_b)), a, b));
  VORPIPE_LET(diff, diffCells(both.first, both.second));
  std::vector<std::uint32_t> first;
  for (const CellDifference& site : diff.first) first.push_back(site.site);
  return differenceOf({diff.equal, diff.statuses, diff.neighbors, diff.areas, "areas", std::move(first)});
}

}  // namespace vorpipe::cli
