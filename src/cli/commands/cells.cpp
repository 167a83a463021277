#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "base/stopwatch.h"
#include "base/try.h"
#include "bench/driver_threads.h"
#include "cli/cells_notes.h"
#include "cli/commands/command.h"
#include "cli/forecast.h"
#include "cli/free_drawing.h"
#include "cli/input.h"
#include "cli/measures.h"
#include "cli/options/cells_outputs.h"
#include "cli/options/density_options.h"
#include "cli/options/error_line.h"
#include "cli/options/mass_options.h"
#include "cli/options/options.h"
#include "cli/progress.h"
#include "cli/run_end.h"
#include "cli/stats.h"
#include "io/base/error.h"
#include "io/cells/cells_file.h"
#include "io/cells/edges_file.h"
#include "io/cells/forecast_files.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::cli {
namespace {

struct CellsCommand {
  InputOptions input;
  BackendOptions backend;
  TalkOptions talk;
  SearchOptions search;
  bool check = false;
  Surface surface = Surface::none;
  CellsTargets targets;
  DensityOptions density;
  std::string stats;
  std::optional<std::uint64_t> memory_limit;
};

/// Returns the requested output files, in the order in which they are created.
std::vector<std::string> outputPaths(const CellsCommand& command) {
  std::vector<std::string> paths = command.targets.paths();
  if (!command.stats.empty()) paths.push_back(command.stats);
  return paths;
}

/// Returns the parts of the cells that the outputs and the check need.
Detail neededDetail(const CellsCommand& command) {
  return command.check ? Detail::everything : command.targets.detail();
}

/// Returns the options of the input: reads attributes only if an output carries them.
InputOptions inputOptions(const CellsCommand& command) {
  InputOptions options = command.input;
  options.reading.attributes = command.targets.carryAttributes();
  return options;
}

std::uint64_t bytesOf(std::span<const Attribute> attributes) {
  std::uint64_t bytes = 0;
  for (const Attribute& attribute : attributes) bytes += attribute.bytes();
  return bytes;
}

/// Returns the memory plan of a run; the density and the input may not have been read yet.
PlanRun planOf(const CellsCommand& command, std::uint64_t density_pixels, std::uint64_t attribute_bytes = 0) {
  return [&command, density_pixels, attribute_bytes](MemoryPlan& plan, Workload work) {
    work.density_pixels = density_pixels;
    if (density_pixels > 0) planDensity(plan, density_pixels);
    const Detail detail = neededDetail(command);
    planSession(plan, work);
    planCells(plan, work, detail);
    if (command.check) planCellsCheck(plan, work, detail);
    for (const CellsTarget& target : command.targets.cells)
      planCellsFile(plan, work, *target.format, attribute_bytes);
    planEdgesFiles(plan, work, command.targets.edgesFormats());
  };
}

std::optional<double> massSum(const Diagram& diagram) {
  if (diagram.mass.empty()) return std::nullopt;
  return std::accumulate(diagram.mass.begin(), diagram.mass.end(), 0.0);
}

/// Returns the topology of a diagram if its edges are written; else an empty one.
Result<Topology> topologyFor(const CellsCommand& command, const Diagram& diagram) {
  if (command.targets.edges.empty()) return {};
  return topologyOf(diagram, command.backend.threads);
}

Result<void> writeFiles(const CellsCommand& command, const Input& input, const Diagram& diagram,
                        const Topology& topology, RunLog& log, std::uint64_t forecast,
                        std::span<OutputFile> files, const Stopwatch& total) {
  const Stopwatch watch;
  const CellsOutput output{input.sites,
                           diagram,
                           input.attributes,
                           input.system,
                           command.targets.only_cells,
                           command.backend.threads};
  std::vector<Writer> writers;
  for (const CellsTarget& target : command.targets.cells) {
    writers.emplace_back(
        [&, format = target.format](ByteSink& to) { return writeCells(to, output, *format); });
  }
  for (const EdgesTarget& target : command.targets.edges) {
    writers.emplace_back([&, format = target.format](ByteSink& to) {
      return writeEdges(to, {diagram, topology, input.system, command.backend.threads}, *format);
    });
  }
  const auto stats = [&] {
    return statsJson({"cells", input, diagram.report, log, watch.milliseconds(), total.milliseconds(),
                      forecast, areaSum(diagram), massSum(diagram)});
  };
  auto written = writeOutputs(files, writers, log, stats);
  if (written) printCellsNotes(command.talk, command.targets, output);
  return written;
}

/// What a run has from its beginning, and needs at its end.
struct Frame {
  RunLog& log;
  std::span<const std::string> paths;
  std::span<OutputFile> files;
  const Stopwatch& total;
};

bool isTiled(const CellsCommand& command) {
  return command.targets.only_measures && command.surface == Surface::none && !command.check &&
         command.density.empty() && canBeTiled(command.input);
}

void printMissing(const TalkOptions& talk, std::uint64_t sites, const Report& report) {
  if (talk.quiet || report.empty == 0) return;
  printNote(fmt::format("{} of {} sites have no cell: they lie outside the domain", report.empty, sites));
}

/// Measures cells in tiles, and writes the measures.
Result<ExitCode> measureInTiles(const CellsCommand& command, const TiledInput& input, Session& session,
                                const Frame& frame) {
  const SitesInPlace places = input.places();
  const auto sizes = forecastTiles(command.input, places.count, input.mapped ? input.mapped->bytes() : 0,
                                   session.device(), command.backend, command.memory_limit);
  if (!sizes) return tl::unexpected(sizes.error());
  ProgressBar bar(command.talk.quiet);
  CellsInTiles tiles(session,
                     {input.input.domain, command.search, sizes->usual, sizes->most, bar.callback()});
  Measured measured(places.count);
  const auto made = tiles.measure(places, sinkOf(measured, command.backend.threads));
  bar.clear();
  if (!made) return asOption(made.error(), command.input);
  const Report& report = made->report;
  printNotes(command.talk, report);
  printMissing(command.talk, places.count, report);
  if (!validationIsSilent(report)) return exit_device;
  const Stopwatch watch;
  const std::vector<Writer> writers(command.targets.cells.size(),
                                    [&](ByteSink& to) { return writeMeasures(to, measured.all()); });
  const auto stats = [&] {
    Stats all{"cells",        input.input,          report,
              frame.log,      watch.milliseconds(), frame.total.milliseconds(),
              sizes->forecast};
    all.area_sum = made->area_sum;
    all.tiles = TileFigures{places.count, made->tiles, made->largest, made->open};
    return statsJson(all);
  };
  const auto written = writeOutputs(frame.files, writers, frame.log, stats);
  if (!written) return tl::unexpected(written.error());
  printSummary(command.talk, frame.paths,
               fmt::format("{}, {} tiles, {}\n", outcomeText(frame.paths, input.input.sites, report),
                           made->tiles, runText(report, frame.total.milliseconds(), false)));
  if (command.talk.verbose && !frame.log.choice.empty()) printNote(frame.log.choice);
  return exit_done;
}

/// Loads the sites of a run, mapped if it is tiled.
Result<TiledInput> loadSitesOf(const CellsCommand& command) {
  if (isTiled(command)) return loadTiled(inputOptions(command), command.backend.threads);
  auto input = loadInput(inputOptions(command));
  if (!input) return tl::unexpected(std::move(input.error()));
  return TiledInput{std::move(*input), std::nullopt};
}

/// Returns the memory plan of a run whose sites are not known yet.
PlanRun planBefore(const CellsCommand& command) {
  if (!isTiled(command)) return planOf(command, command.density.empty() ? 0 : 1);
  return [](MemoryPlan& plan, const Workload& work) { planTiles(plan, work, least_tile); };
}

/// Returns further advice for a run that needs too much memory.
std::string_view adviceOn(const CellsCommand& command) {
  const bool may_be_tiled = !command.targets.only_measures && command.surface == Surface::none &&
                            !command.check && command.density.empty() && command.targets.edges.empty() &&
                            canBeTiled(command.input);
  return may_be_tiled ? "; areas, centroids and numbers of neighbors alone need less: --detail measures" : "";
}

/// Returns the options of the cells, except the progress; adds notes on the density to the input.
Result<CellsOptions> cellsOptions(const CellsCommand& command, Input& input) {
  CellsOptions options{};
  auto density = densityOf(command.density);
  if (!density) return tl::unexpected(std::move(density.error()));
  VORPIPE_TRY(placeUnder(*density, command.density, command.input, input));
  options.density = std::move(density->density);
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  options.search = command.search;
  options.detail = neededDetail(command);
  return options;
}

/// Rejects options that cells with a free surface do not support.
Result<void> checkSurface(const CellsCommand& command) {
  if (command.surface == Surface::none) return {};
  if (command.check) return inputError("--check: what verifies cells does not know free surfaces");
  if (command.targets.edges.empty()) return {};
  return inputError("--edges: cells with a free surface have arcs between them and air; -o has them");
}

/// Rejects a --format that no input or output uses.
Result<void> checkFormat(const CellsCommand& command) {
  const bool given = !command.input.format.output.empty();
  if (!given || command.input.sites == "-" || command.targets.useStandardOutput()) return {};
  return inputError("--format: neither --sites - nor -o - is there to take it");
}

Result<ExitCode> cells(CellsCommand& command, const Invocation& how) {
  setDriverThreads(command.backend.threads);
  const Stopwatch total;
  RunLog log(how, !command.stats.empty());
  log.search = command.search;
  log.threads = command.backend.threads;
  const std::vector<std::string> paths = outputPaths(command);
  if (paths.empty() && !command.check && how.stats == nullptr)
    return tl::unexpected(nothingToDo("cells.csv"));
  VORPIPE_TRY(checkSurface(command));
  VORPIPE_TRY(checkFormat(command));
  VORPIPE_TRY(takeFormat(command.targets, command.input.format.output));
  const auto fits =
      forecastGenerated(command.input, planBefore(command), command.memory_limit, adviceOn(command));
  if (!fits) return tl::unexpected(fits.error());
  auto loaded = loadSitesOf(command);
  if (!loaded) return tl::unexpected(std::move(loaded.error()));
  Input* const input = &loaded->input;
  auto options = cellsOptions(command, *input);
  if (!options) return tl::unexpected(std::move(options.error()));
  const int threads = command.backend.threads;
  VORPIPE_TRY(checkInput(command.input, *input, *options, threads));
  if (command.surface == Surface::free) {
    VORPIPE_TRY(checkDiscs(input->sites));
  }
  printNotes(command.talk, *input);
  auto files = openOutputs(paths);
  if (!files) return tl::unexpected(std::move(files.error()));
  auto session = Session::open(command.backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  log.choice = session->choice();
  if (isTiled(command) && input->sites.weight.empty())
    return measureInTiles(command, *loaded, *session, {log, paths, *files, total});
  const auto forecast =
      forecastRun(command.input, *input, ImagesFor::cells, session->device(), command.backend,
                  planOf(command, options->density.values.size(), bytesOf(input->attributes)),
                  command.memory_limit, input->sites.weight.empty() ? adviceOn(command) : "");
  if (!forecast) return tl::unexpected(forecast.error());
  ProgressBar bar(command.talk.quiet);
  options->progress = bar.callback();
  const bool has_air = command.surface == Surface::free;
  auto diagram =
      has_air ? freeCells(*session, input->sites, *options) : session->cells(input->sites, *options);
  bar.clear();
  if (!diagram) return asOption(diagram.error(), command.input);
  printNotes(command.talk, diagram->report);
  if (!has_air) printMissingCells(command.talk, *input, diagram->status, diagram->report);
  if (!validationIsSilent(diagram->report)) return exit_device;
  if (command.check) {
    const auto passed = passesCheck(check(input->sites, *options, *diagram, threads));
    if (!passed) return tl::unexpected(passed.error());
    if (!*passed) return exit_different;
  }
  auto topology = topologyFor(command, *diagram);
  if (!topology) return tl::unexpected(std::move(topology.error()));
  if (input->projection) toDegrees(*input->projection, *topology, threads);
  backToDegrees(*input, *diagram, threads);
  const auto written = writeFiles(command, *input, *diagram, *topology, log, *forecast, *files, total);
  if (!written) return tl::unexpected(written.error());
  printSummary(command.talk, paths,
               fmt::format("{}, {}\n", outcomeText(paths, input->sites, diagram->report),
                           runText(diagram->report, total.milliseconds(), command.check)));
  if (command.talk.verbose && !log.choice.empty()) printNote(log.choice);
  return exit_done;
}

}  // namespace

void addCells(CommandLine& line) {
  auto command = std::make_shared<CellsCommand>();
  Options options =
      line.addSubcommand("cells",
                         "computes the cells of sites: areas, centroids, neighbors, polygons; with weights, "
                         "those of the power diagram",
                         [command](const Invocation& how) { return cells(*command, how); });
  addInputOptions(options, command->input).required();
  options.group("Output");
  addCellsTargets(options, command->targets);
  options.group("Cells");
  addDensityOptions(options, command->density, "the mass of each cell and its center");
  addSurface(options, command->surface, surface_text);
  addBackendChoice(options, command->backend);
  addSearchOptions(options, command->search);
  addRunOptions(options, command->backend, command->memory_limit);
  options.group("Run");
  options.addFlag(
      "--check", command->check,
      "verifies areas, neighbors, polygons and nearest sites; exit code 1 if a promise is broken");
  options.group("Output");
  addStats(options, command->stats);
  addTalkOptions(options, command->talk, command->backend.waiting);
}

}  // namespace vorpipe::cli
