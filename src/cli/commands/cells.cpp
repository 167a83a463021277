#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "base/stopwatch.h"
#include "bench/measured/driver_threads.h"
#include "cli/commands/command.h"
#include "cli/options/options.h"
#include "cli/reports/stats.h"
#include "cli/runs/forecast.h"
#include "cli/runs/input.h"
#include "cli/runs/run_end.h"
#include "cli/terminal/error_line.h"
#include "cli/terminal/progress.h"
#include "io/cells/cells_file.h"
#include "io/domain/density_file.h"
#include "io/forecast/forecast_files.h"

namespace vorpipe::cli {
namespace {

struct CellsFile {
  std::string path;
  const CellsFormat* format;
};

struct CellsCommand {
  InputOptions input;
  BackendOptions backend;
  TalkOptions talk;
  SearchOptions search;
  bool check = false;
  std::vector<CellsFile> files;
  std::string density, stats;
  std::optional<std::uint64_t> memory_limit;
};

Parsed<CellsFile> parseCellsFile(std::string_view text) {
  auto path = parseFile(text, "");
  if (!path) return tl::unexpected(std::move(path.error()));
  const auto format = cellsFormatOf(*path);
  if (!format) return tl::unexpected(format.error().message);
  return CellsFile{std::move(*path), *format};
}

/// The output files that were asked for, in the order in which they are created.
std::vector<std::string> outputPaths(const CellsCommand& command) {
  std::vector<std::string> paths;
  for (const CellsFile& file : command.files) paths.push_back(file.path);
  if (!command.stats.empty()) paths.push_back(command.stats);
  return paths;
}

/// The parts of the cells that the outputs and the check need.
Detail neededDetail(const CellsCommand& command) {
  Detail detail = command.check ? Detail::everything : Detail::measures;
  for (const CellsFile& file : command.files) detail = std::max(detail, file.format->detail);
  return detail;
}

/// What a run takes; the density may not have been read yet.
PlanRun planOf(const CellsCommand& command, std::uint64_t density_pixels) {
  return [&command, density_pixels](MemoryPlan& plan, Workload work) {
    work.density_pixels = density_pixels;
    if (density_pixels > 0) planDensity(plan, density_pixels);
    const Detail detail = neededDetail(command);
    planSession(plan, work);
    planCells(plan, work, detail);
    if (command.check) planCellsCheck(plan, work, detail);
    for (const CellsFile& file : command.files) planCellsFile(plan, work, *file.format);
  };
}

std::optional<double> massSum(const Diagram& diagram) {
  if (diagram.mass.empty()) return std::nullopt;
  return std::accumulate(diagram.mass.begin(), diagram.mass.end(), 0.0);
}

Result<void> writeFiles(const CellsCommand& command, const Input& input, const Diagram& diagram, RunLog& log,
                        std::uint64_t forecast, std::span<OutputFile> files, const Stopwatch& total) {
  const Stopwatch watch;
  std::vector<Writer> writers;
  for (const CellsFile& file : command.files) {
    writers.emplace_back([&input, &diagram, format = file.format](ByteSink& to) {
      return writeCells(to, input.sites, diagram, *format);
    });
  }
  const auto stats = [&] {
    return statsJson({"cells", input, diagram.report, log, watch.milliseconds(), total.milliseconds(),
                      forecast, areaSum(diagram), massSum(diagram)});
  };
  return writeOutputs(files, writers, log, stats);
}

/// What is computed, but for the progress.
Result<CellsOptions> cellsOptions(const CellsCommand& command, const Input& input) {
  CellsOptions options{};
  if (!command.density.empty()) {
    auto density = readDensity(command.density);
    if (!density) return named("--density", std::move(density.error()));
    options.density = std::move(*density);
  }
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  options.search = command.search;
  options.detail = neededDetail(command);
  return options;
}

Result<ExitCode> cells(const CellsCommand& command, const Invocation& how) {
  setDriverThreads(command.backend.threads);
  const Stopwatch total;
  RunLog log(how, !command.stats.empty());
  log.search = command.search;
  log.threads = command.backend.threads;
  const std::vector<std::string> paths = outputPaths(command);
  if (paths.empty() && !command.check) return tl::unexpected(nothingToDo("cells.csv"));
  const auto fits = forecastGenerated(command.input, planOf(command, command.density.empty() ? 0 : 1),
                                      command.memory_limit);
  if (!fits) return tl::unexpected(fits.error());
  const auto input = loadInput(command.input);
  if (!input) return tl::unexpected(input.error());
  auto options = cellsOptions(command, *input);
  if (!options) return tl::unexpected(std::move(options.error()));
  const int threads = command.backend.threads;
  if (const auto checked = checkInput(command.input, *input, *options, threads); !checked) {
    return tl::unexpected(checked.error());
  }
  auto files = openOutputs(paths);
  if (!files) return tl::unexpected(std::move(files.error()));
  auto session = Session::open(command.backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  log.choice = session->choice();
  const auto forecast =
      forecastRun(command.input, *input, ImagesFor::cells, session->device(), command.backend,
                  planOf(command, options->density.values.size()), command.memory_limit);
  if (!forecast) return tl::unexpected(forecast.error());
  ProgressBar bar(command.talk.quiet);
  options->progress = bar.callback();
  const auto diagram = session->cells(input->sites, *options);
  bar.clear();
  if (!diagram) return asOption(diagram.error(), command.input);
  printNotes(command.talk, diagram->report);
  printMissingCells(command.talk, *input, diagram->status, diagram->report);
  if (!validationIsSilent(diagram->report)) return exit_device;
  if (command.check) {
    const auto passed = passesCheck(check(input->sites, *options, *diagram, threads));
    if (!passed) return tl::unexpected(passed.error());
    if (!*passed) return exit_different;
  }
  const auto written = writeFiles(command, *input, *diagram, log, *forecast, *files, total);
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
  const auto extensions = cellsExtensions();
  addRepeatable(
      options, "-o", "FILE",
      fmt::format("the cells in input order, by the extension: {}; repeatable", fmt::join(extensions, ", ")),
      parseCellsFile, [files = &command->files](CellsFile file) { files->push_back(std::move(file)); },
      {{}, {extensions.begin(), extensions.end()}});
  options.group("Cells");
  addAnyFile(
      options, "--density", command->density, {".png", ".npy"},
      "a density over the domain, .png (dark is dense) or .npy, pixels with row 0 at the top: the mass "
      "of each cell and its center");
  addBackendChoice(options, command->backend);
  addSearchOptions(options, command->search);
  addRunOptions(options, command->backend, command->memory_limit);
  options.group("Run");
  options.addFlag(
      "--check", command->check,
      "verifies areas, neighbors, polygons and nearest sites; exit code 1 if a promise is broken");
  options.group("Output");
  addStats(options, command->stats);
  addTalkOptions(options, command->talk);
}

}  // namespace vorpipe::cli
