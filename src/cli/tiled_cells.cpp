#include "cli/tiled_cells.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "cli/options/error_line.h"
#include "cli/progress.h"
#include "io/cells/cells_file.h"

namespace vorpipe::cli {
namespace {

/// Measures in the order of the input.
struct Measured {
  explicit Measured(std::size_t sites) : area(sites), centroid(sites), neighbors(sites), status(sites) {}

  std::vector<double> area;
  std::vector<Point> centroid;
  std::vector<std::uint32_t> neighbors;
  std::vector<Status> status;
};

/// Returns a sink that stores measures at their sites' indices, on several threads.
CellsSink sinkOf(Measured& measured, int threads) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  return [&measured, threads](std::span<const std::uint32_t> sites,
                              std::span<const CellMeasures> measures) -> Result<void> {
    parallelEach(sites.size(), grain, threads, [&](std::size_t k) {
      const auto i = sites[k];
      const CellMeasures& cell = measures[k];
      measured.area[i] = cell.area;
      measured.centroid[i] = cell.centroid;
      measured.neighbors[i] = cell.neighbors;
      measured.status[i] = cell.status;
    });
    return {};
  };
}

}  // namespace

bool canBeTiled(const InputOptions& options) {
  return !options.random_weights && options.weights.empty() && !options.periodic.any() &&
         !options.domain.hull && options.domain.file.empty() && !options.project && !options.globe;
}

Result<TiledInput> loadTiled(const CommandRun& run, const InputOptions& options) {
  const Stopwatch watch;
  TiledInput tiled;
  if (options.sites.ends_with(".npy") && options.reading.columns.empty() && !options.reading.skip_missing) {
    auto mapped = MappedSites::map(options.sites, run.options.backend.threads);
    if (!mapped) return named("--sites", std::move(mapped.error()));
    tiled.mapped = std::move(*mapped);
  }
  const PlanRun plan_least = [](MemoryPlan& plan, const Workload& work) {
    planTiles(plan, work, least_tile);
  };
  VORPIPE_VAR(input,
              tiled.mapped ? inputAround(options, tiled.mapped->corners()) : run.load(options, plan_least));
  tiled.input = std::move(input);
  if (tiled.mapped) tiled.input.read_ms = watch.milliseconds();
  return tiled;
}

Result<ExitCode> measureInTiles(CommandRun& run, const InputOptions& options, const TiledInput& input,
                                std::size_t files) {
  const RunOptions& with = run.options;
  VORPIPE_TRY(
      checkInput(options, input.input, cellsOptionsOf(input.input, with.search), with.backend.threads));
  printNotes(with.talk, input.input);
  VORPIPE_TRY(run.createFiles());
  VORPIPE_TRY(run.openSession());
  const SitesInPlace places = input.places();
  VORPIPE_LET(sizes, forecastTiles(options, places.count, input.mapped ? input.mapped->bytes() : 0,
                                   run.session->device(), with.backend, with.memory_limit));
  run.forecast = sizes.forecast;
  ProgressBar bar(with.talk.quiet);
  CellsInTiles tiles(*run.session,
                     {input.input.domain, with.search, sizes.usual, sizes.most, bar.callback()});
  Measured measured(places.count);
  const auto found = tiles.measure(places, sinkOf(measured, with.backend.threads));
  bar.clear();
  if (!found) return asOption(found.error(), options);
  const Report& report = found->report;
  printNotes(with.talk, report);
  if (!with.talk.quiet && report.empty > 0) {
    printNote(
        fmt::format("{} of {} sites have no cell: they lie outside the domain", report.empty, places.count));
  }
  if (!validationIsSilent(report)) return exit_device;
  RunOutput output{input.input, report};
  output.writers.assign(files, [&](ByteSink& to) {
    return writeMeasures(to, {measured.area, measured.centroid, measured.neighbors, measured.status});
  });
  output.figures = [&](nlohmann::ordered_json& json) {
    json["sites"] = places.count;
    json["area_sum"] = found->area_sum;
    json["tiles"] = {{"count", found->tiles}, {"largest", found->largest}, {"open", found->open}};
  };
  VORPIPE_TRY(run.write(output));
  run.printSummary(fmt::format("{}, {} tiles", run.outcome(input.input.sites, report), found->tiles), report);
  return exit_done;
}

}  // namespace vorpipe::cli
