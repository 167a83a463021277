#include <algorithm>
#include <functional>
#include <new>
#include <utility>
#include <vector>

#include "base/try.h"
#include "session/session_state.h"
#include "space/box_cells.h"
#include "space/periodic_cells.h"
#include "vorpipe.h"

namespace vorpipe {
namespace {

Result<Diagram3> findSpaceCells(std::span<const Point3> sites, const Cells3Options& options, int threads) {
  VORPIPE_TRY(checkInput(sites, options, threads));
  VORPIPE_VAR(diagram, options.repeats() ? space::periodicCells(sites, options, threads)
                                         : space::boxCells(sites, options, threads));
  Report& report = diagram.report;
  for (const Status of_site : diagram.status) {
    report.ok += of_site == Status::ok ? 1 : 0;
    report.empty += of_site == Status::empty ? 1 : 0;
    report.duplicate += of_site == Status::duplicate ? 1 : 0;
  }
  if (std::ranges::adjacent_find(options.weights, std::not_equal_to()) != options.weights.end())
    report.hidden = report.empty;
  return std::move(diagram);
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
