#include "core/diagram/box_diagram.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/refusal.h"
#include "base/stopwatch.h"
#include "core/diagram/diagram_writer.h"
#include "core/diagram/dual_triangles.h"
#include "core/search/neighbor_search.h"
#include "core/ties/reconcile.h"

namespace vorpipe::core {
namespace {

/// Agrees on cells whose areas add up to that of the domain. That they do not although neighbors agree
/// everywhere takes a diagram that lies over itself, so that no cell on its own is known to be wrong:
/// all are found again.
Result<TiedCells> agree(const SearchInput& input, NeighborRows& rows, const Records& records,
                        const Box& domain, Report& report) {
  auto tied = reconcileCells(input, rows, records, report);
  if (!tied || std::abs(areaGap(records.by_input, domain, input.threads)) <= area_rounding) return tied;
  std::vector<std::uint32_t> all(input.sites.size());
  std::iota(all.begin(), all.end(), 0u);
  if (auto found = findAgain(input, all, Precision::in_double, rows); !found) {
    return tl::unexpected(found.error());
  }
  report.in_double += all.size();
  tied = reconcileCells(input, rows, records, report);
  if (!tied) return tied;
  const double gap = areaGap(records.by_input, domain, input.threads);
  if (std::abs(gap) <= area_wrong) return tied;
  return tl::unexpected(refusal(
      Subject::sites,
      fmt::format("the areas of all cells add up to {} of the domain's, beyond what rounding explains",
                  1 + gap)));
}

/// The centroid of a site without a cell is the site, as the caller has it to the last bit: scaled ones may
/// be rounded.
void keepSitesWithoutCells(const Sites& sites, int threads, Diagram& diagram) {
  constexpr std::size_t grain = 1 << 14;
  parallelFor(sites.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      if (diagram.status[i] == Status::empty) diagram.centroid[i] = {sites.x[i], sites.y[i]};
    }
  });
}

}  // namespace

Result<Diagram> boxDiagramOn(const Machine& machine, SiteRun& run, const Sites& sites,
                             const CellsOptions& options) {
  Diagram diagram;
  auto& times = diagram.report.time_ms;
  const Stopwatch watch;
  const int threads = machine.threads;
  const SiteSet& set = run.prepared.set;
  const SearchInput input{machine.backend, run.judge, set, options.search, threads, options.progress};
  auto rows = findNeighbors(input, diagram.report);
  if (!rows) return tl::unexpected(rows.error());
  auto by_input = makeRecords(run.prepared, sites);
  const Records records{set, Unscale(run.prepared.exponent), by_input};
  const auto tied = agree(input, *rows, records, options.domain, diagram.report);
  if (!tied) return tl::unexpected(tied.error());
  takeRecords(by_input, options.detail, threads, diagram);
  BigVector<CellRecord>().swap(by_input);  // to be assigned nothing would leave it its memory
  if (diagram.report.empty > 0) keepSitesWithoutCells(sites, threads, diagram);
  if (!set.weight.empty()) diagram.report.hidden = diagram.report.empty;
  {
    const EdgeIndex index(*rows, threads);
    const ProposedCells agreed{set, *rows, index, threads};
    writeEdges(agreed, *tied, options.detail, records.unscale, diagram);
    if (options.detail == Detail::everything) diagram.triangles = dualTriangles(agreed, *tied, run.mesh);
  }
  run.cells = std::move(*rows);
  diagram.owner = std::move(run.prepared.owner);
  times.cells = 1e3 * watch.seconds() - std::max(times.upload, 0.0) - std::max(times.search, 0.0);
  nameDevice(machine.backend, diagram.report);
  return diagram;
}

}  // namespace vorpipe::core
