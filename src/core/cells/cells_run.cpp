#include "core/cells/cells_run.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "core/diagram/box_diagram.h"
#include "core/diagram/diagram_writer.h"
#include "core/outline/clip_diagram.h"
#include "core/periodic/periodic_diagram.h"

namespace vorpipe::core {

Result<Diagram> cellsOn(Backend& backend, Backend& judge_backend, int threads, const Sites& sites,
                        const CellsOptions& options) {
  if (options.periodic != Periodic::none) {
    return periodicCellsOn(backend, judge_backend, threads, sites, options);
  }
  CellsOptions box_options = options;
  // To clip cells takes their polygons, whether they are wanted or not.
  if (!options.outline.empty()) box_options.detail = std::max(options.detail, Detail::polygons);
  auto box = boxDiagramOn(backend, judge_backend, threads, sites, box_options);
  if (!box) return tl::unexpected(box.error());
  Diagram& diagram = box->diagram;
  if (!options.outline.empty()) {
    const Stopwatch watch;
    const ClippedRun run{sites, options.domain, box->order, box->exponent, threads};
    if (auto clipped = clipToOutline(run, options.outline, diagram); !clipped) {
      return tl::unexpected(clipped.error());
    }
    if (options.detail == Detail::measures) dropPolygons(diagram);
    diagram.report.time_ms.cells += 1e3 * watch.seconds();
  }
  return std::move(diagram);
}

}  // namespace vorpipe::core
