#include "core/cells/cells_run.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "core/diagram/box_diagram.h"
#include "core/diagram/diagram_writer.h"
#include "core/outline/clip_diagram.h"

namespace vorpipe::core {
namespace {

/// Clips the cells of a run.
Result<void> clip(const Machine& machine, const Sites& sites, const CellsOptions& options, FoundCells& found,
                  ImagesFor purpose) {
  const Stopwatch watch;
  Diagram& diagram = found.diagram;
  const int exponent = found.run->prepared.exponent;
  std::vector<std::uint32_t> order;
  if (purpose == ImagesFor::cells) {
    order = std::move(found.run->prepared.set.id);
    found.run.reset();
  } else {
    order = found.run->prepared.set.id;
  }
  const ClippedRun run{sites, options.domain, order, exponent, machine.threads};
  if (auto clipped = clipToOutline(run, options.outline, diagram); !clipped) return clipped;
  if (options.detail == Detail::measures) dropPolygons(diagram);
  diagram.report.time_ms.cells += 1e3 * watch.seconds();
  return {};
}

}  // namespace

Result<FoundCells> findCells(const Machine& machine, const Sites& sites, const CellsOptions& options,
                             ImagesFor purpose) {
  if (options.periodic != Periodic::none) return periodicCellsOn(machine, sites, options, purpose);
  CellsOptions box_options = options;
  // To clip cells takes their polygons, whether they are wanted or not.
  if (!options.outline.empty()) box_options.detail = std::max(options.detail, Detail::polygons);
  const Stopwatch order_watch;
  auto run = beginRun(machine, sites, options.domain);
  if (!run) return tl::unexpected(run.error());
  const double order_ms = 1e3 * order_watch.seconds();
  auto diagram = boxDiagramOn(machine, **run, sites, box_options);
  if (!diagram) return tl::unexpected(diagram.error());
  diagram->report.time_ms.order = order_ms;
  FoundCells found{std::move(*diagram), std::move(*run), plainScene(sites, options.domain)};
  if (!options.outline.empty()) {
    if (auto clipped = clip(machine, sites, options, found, purpose); !clipped) {
      return tl::unexpected(clipped.error());
    }
  }
  return found;
}

Result<Diagram> cellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options) {
  auto found = findCells(machine, sites, options, ImagesFor::cells);
  if (!found) return tl::unexpected(found.error());
  return std::move(found->diagram);
}

}  // namespace vorpipe::core
