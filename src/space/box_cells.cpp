#include "space/box_cells.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "space/certified_cells.h"
#include "space/certify.h"
#include "space/site_bins.h"

namespace vorpipe::space {
namespace {

/// Refuses sites whose places are two, and one in a run's coordinates: in those of a large domain they are so
/// small that no double has them.
Result<void> refuseMerged(std::span<const Point3> sites, std::span<const std::uint32_t> owner) {
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    const std::uint32_t first = owner[i];
    if (first != i && sites[first] != sites[i])
      return tl::unexpected(nearSites(first, sites[first], i, sites[i]));
  }
  return {};
}

}  // namespace

Result<Diagram3> boxCells(std::span<const Point3> sites, const Cells3Options& options, int threads,
                          LeftOut* left_out) {
  Diagram3 diagram;
  Report& report = diagram.report;
  const Stopwatch clock;
  const SiteBins bins = binSites(sites, options.domain, threads, options.weights);
  VORPIPE_TRY(refuseMerged(sites, bins.owner));
  report.time_ms.order = clock.milliseconds();
  Records records(bins.places(), 1 / bins.scale, bins.input, sites, options.detail, threads, diagram);
  if (left_out != nullptr) {
    const double heaviest = bins.hasWeights() ? *std::ranges::max_element(bins.weights) : 0;
    left_out->beyond.assign(sites.size(), HUGE_VAL);
    records.want(left_out->wanted);
    records.watchBalls({bins.box, left_out->axes, heaviest}, left_out->beyond);
  }
  VORPIPE_VAR(found, certify(bins, records, options.progress, threads));
  std::vector<Status> status(sites.size(), Status::duplicate);
  constexpr std::size_t grain = 4096;
  parallelEach(bins.sites.size(), grain, threads, [&](std::size_t k) {
    status[bins.input[k]] = found.rows[k].faces > 0 ? Status::ok : Status::empty;
  });
  const ProvedCells proved{bins.places(),    1 / bins.scale, found.rows, bins.input, found.tied,
                           found.unmeasured, sites,          status,     bins.owner};
  VORPIPE_TRY(writeDiagram(proved, records, options.detail, threads, diagram));
  report.time_ms.cells = clock.milliseconds() - report.time_ms.order;
  report.exact = found.exact;
  return diagram;
}

}  // namespace vorpipe::space
