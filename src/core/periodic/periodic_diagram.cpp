#include "core/periodic/periodic_diagram.h"

#include <fmt/core.h>

#include <cmath>

#include "base/refusal.h"
#include "base/stopwatch.h"
#include "core/diagram/box_diagram.h"
#include "core/diagram/diagram_writer.h"
#include "core/periodic/band.h"
#include "core/periodic/band_proof.h"
#include "core/periodic/seam.h"
#include "core/periodic/unwrap.h"

namespace vorpipe::core {
namespace {

/// Adds up the times of all runs; a stage that none had stays negative.
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

/// Runs over sites and images, with wider and wider bands.
class Runs {
 public:
  Runs(Backend& backend, Backend& judge, int threads, const Sites& sites, const PeriodicSites& placed,
       CellsOptions options)
      : backend_(backend),
        judge_(judge),
        threads_(threads),
        callers_{sites, [this](std::uint32_t i) { return imaged.siteOf(i); }},
        placed_(placed),
        options_(std::move(options)) {
    options_.periodic = Periodic::none;
    options_.density = {};
    options_.detail = Detail::polygons;  // The proof is about vertices.
  }

  Result<void> cells(const Band& band) {
    const Stopwatch order_watch;
    diagram = {};
    imaged = {};
    imaged = withImages(placed_, band);
    times.order = std::max(times.order, 0.0) + 1e3 * order_watch.seconds();
    options_.domain = imaged.box;
    auto run = boxDiagramOn(backend_, judge_, threads_, imaged.sites, options_, &callers_);
    if (!run) return tl::unexpected(run.error());
    auto messages = std::move(diagram.report.validation_messages);
    diagram = std::move(run->diagram);
    auto& said = diagram.report.validation_messages;
    said.insert(said.begin(), messages.begin(), messages.end());
    addTimes(diagram.report.time_ms, times);
    return {};
  }

  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;

  /// After `cells`: the next band to try, or `band` itself if the cells are right.
  Result<Band> settle(const Band& band) {
    const Stopwatch watch;
    const Band proved = bandThatProves(placed_, imaged, diagram, band, threads_);
    const bool whole = isWhole(band, placed_);
    if (proved.width != band.width) return proved;
    if (!whole && !isClosed(imaged, diagram)) return wholeBand(placed_, band);
    keepSites(imaged, diagram);
    const bool settled = settleSeam(placed_, imaged, diagram);
    const double gap = areaGap(diagram, placed_.domain(), threads_);
    times.cells = std::max(times.cells, 0.0) + 1e3 * watch.seconds();
    if (!whole && !(settled && std::abs(gap) <= area_rounding)) return wholeBand(placed_, band);
    if (settled && std::abs(gap) <= area_wrong) return band;
    return tl::unexpected(refusal(
        Subject::period,
        fmt::format("the cells of the periodic domain do not agree across its border, and add up to {} "
                    "of it, beyond what rounding explains",
                    1 + gap)));
  }

  ImagedSites imaged;
  Diagram diagram;
  Times times;

 private:
  Backend& backend_;
  Backend& judge_;
  int threads_;
  CallersSites callers_;
  const PeriodicSites& placed_;
  CellsOptions options_;
};

}  // namespace

Result<Diagram> periodicCellsOn(Backend& backend, Backend& judge_backend, int threads, const Sites& sites,
                                const CellsOptions& options) {
  const Stopwatch order_watch;
  auto placed = placeSites(sites, options.domain, options.periodic, threads);
  if (!placed) return tl::unexpected(placed.error());
  Band band = likelyBandForCells(*placed, threads);
  Runs runs(backend, judge_backend, threads, sites, *placed, options);
  runs.times.order = 1e3 * order_watch.seconds();
  for (;;) {
    if (auto run = runs.cells(band); !run) return tl::unexpected(run.error());
    auto next = runs.settle(band);
    if (!next) return tl::unexpected(next.error());
    if (next->width == band.width) break;
    band = std::move(*next);
  }
  const Stopwatch records_watch;
  finishRecords(*placed, runs.imaged, options.detail, threads, runs.diagram);
  runs.times.cells += 1e3 * records_watch.seconds();
  runs.diagram.report.time_ms = runs.times;
  return std::move(runs.diagram);
}

}  // namespace vorpipe::core

namespace vorpipe {

Result<std::uint64_t> sitesAndImages(const Sites& sites, const Box& domain, Periodic periodic,
                                     ImagesFor purpose, int threads) {
  if (periodic == Periodic::none) return sites.size();
  const auto placed = core::placeSites(sites, domain, periodic, threads);
  if (!placed) return tl::unexpected(placed.error());
  const bool pictures = purpose == ImagesFor::pictures;
  const core::Band band =
      pictures ? core::bandForPlaces(*placed, threads) : core::likelyBandForCells(*placed, threads);
  std::uint64_t count = sites.size();
  core::eachImage(*placed, band, [&](const core::SiteImage&) { ++count; });
  return count;
}

}  // namespace vorpipe
