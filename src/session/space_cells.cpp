#include <new>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "session/session_state.h"
#include "space/certified_cells.h"
#include "space/certify.h"
#include "space/site_bins.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

Result<Diagram3> findSpaceCells(std::span<const Point3> sites, const Cells3Options& options, int threads) {
  VORPIPE_TRY(checkInput(sites, options, threads));
  Diagram3 diagram;
  Report& report = diagram.report;
  const Stopwatch clock;
  const space::SiteBins bins = space::binSites(sites, options.domain, threads);
  report.time_ms.order = clock.milliseconds();
  space::Records records(bins.places(), 1 / bins.scale, bins.input, sites, options.detail, threads, diagram);
  VORPIPE_VAR(found, space::certify(bins, records, options.progress, threads));
  std::vector<Status> status(sites.size(), Status::duplicate);
  constexpr std::size_t grain = 4096;
  parallelEach(bins.sites.size(), grain, threads, [&](std::size_t k) {
    status[bins.input[k]] = found.rows[k].faces > 0 ? Status::ok : Status::empty;
  });
  const space::ProvedCells proved{bins.places(),    1 / bins.scale, found.rows, bins.input, found.tied,
                                  found.unmeasured, sites,          status,     bins.owner};
  VORPIPE_TRY(space::writeDiagram(proved, records, options.detail, threads, diagram));
  report.time_ms.cells = clock.milliseconds() - report.time_ms.order;
  for (const Status of_site : diagram.status) {
    report.ok += of_site == Status::ok ? 1 : 0;
    report.empty += of_site == Status::empty ? 1 : 0;
    report.duplicate += of_site == Status::duplicate ? 1 : 0;
  }
  report.exact = found.exact;
  return diagram;
}

}  // namespace

Result<Diagram3> Session::cells(std::span<const Point3> sites, const Cells3Options& options) {
  try {
    VORPIPE_VAR(diagram, findSpaceCells(sites, options, state_->threads));
    const DeviceInfo& info = state_->device.info();
    diagram.report.backend = info.backend;
    diagram.report.device = info.name;
    diagram.report.driver = info.driver;
    return std::move(diagram);
  } catch (const std::bad_alloc&) {
    return tl::unexpected(outOfMemory());
  }
}

}  // namespace vorpipe
