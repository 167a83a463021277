#include "domain/cells_run.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "base/try.h"
#include "cells/agreed_cells.h"
#include "cells/diagram_writer.h"
#include "domain/clip_diagram.h"

namespace vorpipe::core {
namespace {

/// Clips the cells of a run.
Result<void> clip(const Machine& machine, const Sites& sites, const CellsOptions& options,
                  FoundCells& found) {
  const Stopwatch watch;
  Diagram& diagram = found.diagram;
  const SiteRun& of = *found.run;
  const ClippedRun run{sites,     options.domain,       of.prepared.set,
                       *of.cells, of.prepared.exponent, machine.threads};
  auto parts = clipToOutline(run, options.outline, diagram);
  if (!parts) return tl::unexpected(parts.error());
  found.parts = std::move(*parts);
  if (options.detail == Detail::measures) dropPolygons(diagram);
  diagram.report.time_ms.cells += 1e3 * watch.seconds();
  return {};
}

}  // namespace

Result<FoundCells> findCells(const Machine& machine, const Sites& sites, const CellsOptions& options,
                             ImagesFor purpose) {
  if (options.periodic != Periodic::none) {
    auto cells = periodicCellsOn(machine, sites, options, purpose);
    if (!cells) return tl::unexpected(cells.error());
    return FoundCells{std::move(cells->diagram), std::move(cells->run), std::move(cells->scene)};
  }
  CellsOptions box_options = options;
  // Clipping cells needs their polygons, even if the caller does not.
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
    VORPIPE_TRY(clip(machine, sites, options, found));
  }
  if (purpose == ImagesFor::cells) found.run.reset();
  return found;
}

Result<Diagram> cellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options) {
  auto found = findCells(machine, sites, options, ImagesFor::cells);
  if (!found) return tl::unexpected(found.error());
  return std::move(found->diagram);
}

}  // namespace vorpipe::core
