#include "domain/cells_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/refusal.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "cells/agreed_cells.h"
#include "cells/diagram_writer.h"
#include "domain/periodic_records.h"
#include "sites/images.h"

namespace vorpipe::core {
namespace {

/// Adds up the times of all runs; a stage that occurred in none stays negative.
void addTimes(const Times& run, Times& sum) {
  const auto add = [](double from, double& to) {
    if (from >= 0) to = std::max(to, 0.0) + from;
  };
  add(run.order, sum.order);
  add(run.upload, sum.upload);
  add(run.search, sum.search);
  add(run.cells, sum.cells);
}

bool isWhole(const Band& band, const PeriodicSites& placed) {
  return isWhole(band, placed, 0) && isWhole(band, placed, 1);
}

Band wholeBand(const PeriodicSites& placed, Band band) {
  for (const std::size_t a : {0u, 1u}) band.width[a] = placed.axis[a].periodic ? placed.axis[a].length : 0;
  return band;
}

/// Runs over sites and images, with increasingly wide bands.
class Runs {
 public:
  Runs(const Machine& machine, const Sites& sites, const PeriodicSites& placed, CellsOptions options,
       ImagesFor purpose)
      : machine_(machine),
        callers_{sites, [this](std::uint32_t i) { return imaged.siteOf(i); }, placed.domain()},
        placed_(placed),
        options_(std::move(options)),
        purpose_(purpose) {
    options_.periodic = Periodic::none;
    options_.density = {};
    options_.detail = Detail::polygons;  // The proof is about vertices.
  }

  Result<void> cells(const Band& band) {
    const Stopwatch order_watch;
    run.reset();
    diagram = {};
    imaged = {};
    imaged = withImages(placed_, band);
    options_.domain = imaged.box;
    VORPIPE_VAR(begun, beginRun(machine_, imaged.sites, options_.domain, &callers_));
    times.order = std::max(times.order, 0.0) + 1e3 * order_watch.seconds();
    run = std::move(begun);
    VORPIPE_VAR(found, boxDiagramOn(machine_, *run, imaged.sites, options_));
    if (purpose_ == ImagesFor::cells) run.reset();
    const Report before = std::move(diagram.report);
    diagram = std::move(found);
    auto& said = diagram.report.validation_messages;
    said.insert(said.begin(), before.validation_messages.begin(), before.validation_messages.end());
    auto& made = diagram.report.pipelines;
    made.insert(made.begin(), before.pipelines.begin(), before.pipelines.end());
    addTimes(diagram.report.time_ms, times);
    return {};
  }

  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;

  /// After `cells`: the next band to try, or `band` itself if the cells are right.
  Result<Band> settle(const Band& band) {
    const Stopwatch watch;
    const Band proved = bandThatProves(placed_, imaged, diagram, band, machine_.threads);
    const bool whole = isWhole(band, placed_);
    if (proved.width != band.width) return proved;
    if (!whole && !isClosed(imaged, diagram)) return wholeBand(placed_, band);
    keepSites(imaged, diagram);
    const bool settled = settleSeam(placed_, imaged, diagram);
    const double gap = areaGap(diagram, placed_.domain(), machine_.threads);
    times.cells = std::max(times.cells, 0.0) + 1e3 * watch.seconds();
    if (!whole && !(settled && std::abs(gap) <= area_rounding)) return wholeBand(placed_, band);
    if (settled && std::abs(gap) <= area_wrong) return band;
    return tl::unexpected(refusal(
        Subject::period,
        fmt::format("the cells of the periodic domain do not agree across its border, and add up to {} "
                    "of it, beyond what rounding explains",
                    1 + gap)));
  }

  std::unique_ptr<SiteRun> run;
  ImagedSites imaged;
  Diagram diagram;
  Times times;

 private:
  const Machine& machine_;
  CallersSites callers_;
  const PeriodicSites& placed_;
  CellsOptions options_;
  ImagesFor purpose_;
};

/// Finds the cells of a periodic domain, from an ordinary diagram of the sites and some images.
Result<FoundCells> findPeriodicCells(const Machine& machine, const Sites& sites, const CellsOptions& options,
                                     ImagesFor purpose) {
  const Stopwatch order_watch;
  VORPIPE_VAR(placed, placeSites(sites, options.domain, options.periodic, machine.threads));
  // As wide as a picture needs, and more.
  Band band = likelyBandForCells(placed, machine.threads);
  Runs runs(machine, sites, placed, options, purpose);
  runs.times.order = 1e3 * order_watch.seconds();
  for (;;) {
    VORPIPE_TRY(runs.cells(band));
    VORPIPE_VAR(next, runs.settle(band));
    if (next.width == band.width) break;
    band = std::move(next);
  }
  const Stopwatch records_watch;
  finishRecords(placed, runs.imaged, options.detail, machine.threads, runs.diagram);
  runs.times.cells += 1e3 * records_watch.seconds();
  runs.diagram.report.time_ms = runs.times;
  const Box clip = runs.imaged.box;
  return FoundCells{std::move(runs.diagram), std::move(runs.run),
                    Scene{std::move(runs.imaged), clip, placed.domain()}};
}

/// Clips the cells of a run to its outline.
Result<void> clip(const Machine& machine, const Sites& sites, const CellsOptions& options,
                  FoundCells& found) {
  const Stopwatch watch;
  Diagram& diagram = found.diagram;
  const SiteRun& of = *found.run;
  const ClippedRun run{sites,     options.domain,       of.prepared.set,
                       *of.cells, of.prepared.exponent, machine.threads};
  VORPIPE_VAR(parts, clipToOutline(run, options.outline, diagram));
  found.parts = std::move(parts);
  if (options.detail == Detail::measures) dropPolygons(diagram);
  diagram.report.time_ms.cells += 1e3 * watch.seconds();
  return {};
}

}  // namespace

Result<FoundCells> findCells(const Machine& machine, const Sites& sites, const CellsOptions& options,
                             ImagesFor purpose) {
  if (options.periodic != Periodic::none) return findPeriodicCells(machine, sites, options, purpose);
  CellsOptions box_options = options;
  // Clipping cells needs their polygons, even if the caller does not.
  if (!options.outline.empty()) box_options.detail = std::max(options.detail, Detail::polygons);
  const Stopwatch order_watch;
  VORPIPE_VAR(run, beginRun(machine, sites, options.domain));
  const double order_ms = 1e3 * order_watch.seconds();
  VORPIPE_VAR(diagram, boxDiagramOn(machine, *run, sites, box_options));
  diagram.report.time_ms.order = order_ms;
  FoundCells found{std::move(diagram), std::move(run), plainScene(sites, options.domain)};
  if (!options.outline.empty()) VORPIPE_TRY(clip(machine, sites, options, found));
  if (purpose == ImagesFor::cells) found.run.reset();
  return found;
}

Result<Diagram> cellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options) {
  return findCells(machine, sites, options, ImagesFor::cells).map([](FoundCells&& found) {
    return std::move(found.diagram);
  });
}

}  // namespace vorpipe::core

namespace vorpipe {

Result<std::uint64_t> sitesAndImages(const Sites& sites, const Box& domain, Periodic periodic,
                                     ImagesFor purpose, int threads) {
  if (periodic == Periodic::none) return sites.size();
  VORPIPE_LET(placed, core::placeSites(sites, domain, periodic, threads));
  const bool pictures = purpose == ImagesFor::pictures;
  const core::Band band =
      pictures ? core::bandForPlaces(placed, threads) : core::likelyBandForCells(placed, threads);
  std::uint64_t count = sites.size();
  core::eachImage(placed, band, [&](const core::SiteImage&) { ++count; });
  return count;
}

}  // namespace vorpipe
