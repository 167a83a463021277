#include "cells/box_diagram.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "cells/agreed_cells.h"
#include "cells/diagram_writer.h"
#include "cells/dual_triangles.h"

namespace vorpipe::core {
namespace {

/// The centroid of a site without a cell is the caller's site, to the last bit: scaled ones may be rounded.
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
  auto agreed = agreeOnCells(machine, run, sites, options, {}, diagram.report);
  if (!agreed) return tl::unexpected(agreed.error());
  takeRecords(agreed->records, options.detail, threads, diagram);
  BigVector<CellRecord>().swap(agreed->records);  // assigning an empty one would keep the memory
  if (diagram.report.empty > 0) keepSitesWithoutCells(sites, threads, diagram);
  if (!set.weight.empty()) diagram.report.hidden = diagram.report.empty;
  {
    const EdgeIndex index(agreed->rows, threads);
    const ProposedCells cells{set, agreed->rows, index, threads};
    writeEdges(cells, agreed->tied, options.detail, Unscale(run.prepared.exponent), diagram);
    if (options.detail == Detail::everything)
      diagram.triangles = dualTriangles(cells, agreed->tied, run.mesh);
  }
  run.cells = std::move(agreed->rows);
  diagram.owner = std::move(run.prepared.owner);
  times.cells = 1e3 * watch.seconds() - std::max(times.upload, 0.0) - std::max(times.search, 0.0);
  nameDevice(machine.backend, diagram.report);
  return diagram;
}

}  // namespace vorpipe::core
