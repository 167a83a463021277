#include <fmt/format.h>

#include <memory>
#include <numeric>

#include "base/stopwatch.h"
#include "base/try.h"
#include "bench/driver_threads.h"
#include "cli/commands/command.h"
#include "cli/drawn_input.h"
#include "cli/forecast.h"
#include "cli/input.h"
#include "cli/options/density_options.h"
#include "cli/options/error_line.h"
#include "cli/options/mass_options.h"
#include "cli/options/options.h"
#include "cli/options/picture_options.h"
#include "cli/options/result_outputs.h"
#include "cli/progress.h"
#include "cli/result_files.h"
#include "cli/run_end.h"
#include "cli/stats.h"
#include "cli/transport_run.h"
#include "io/base/error.h"
#include "io/base/number.h"
#include "io/cells/forecast_files.h"
#include "io/sites/weights_file.h"

namespace vorpipe::cli {
namespace {

struct TransportCommand {
  InputOptions input;
  BackendOptions backend;
  TalkOptions talk;
  SearchOptions search;
  PictureOptions picture;
  MassOptions masses;
  double tolerance = TransportOptions{}.tolerance;
  std::uint64_t diagrams = TransportOptions{}.diagrams;
  ResultTargets targets;
  DensityOptions density;
  std::string weights, stats;
  std::optional<std::uint64_t> memory_limit;
};

Parsed<double> parseTolerance(std::string_view text) {
  const auto number = parseNumber(text);
  if (!number) return tl::unexpected(number.error());
  if (*number > 0) return *number;
  return tl::unexpected(fmt::format("{} is not a number above 0", *number));
}

/// Returns the requested output files, in the order in which they are created.
std::vector<std::string> outputPaths(const TransportCommand& command) {
  return command.targets.pathsWith({command.weights, command.targets.trace, command.stats});
}

/// Returns the memory plan of a run: cells, the matrix and the levels of its solver, then files; `domain` if
/// known.
PlanRun planOf(const TransportCommand& command, std::uint64_t density_pixels,
               const std::optional<Box>& domain = {}) {
  return [&command, density_pixels, domain](MemoryPlan& plan, Workload work) {
    // As measured: weights and what is missing, the matrix and the levels of its solver; polygons of cells in
    // periods and outlines; what drivers keep from one diagram to the next.
    constexpr std::uint64_t of_any = 6'000'000, of_device = 8'000'000, in_box = 900, of_surface = 680,
                            of_polygons = 1360;
    const bool has_air = command.masses.around() == Surface::free;
    const auto of_newton = work.periodic || work.outlined ? of_polygons : has_air ? of_surface : in_box;
    work.density_pixels = density_pixels;
    work.weighted = true;
    if (density_pixels > 0) planDensity(plan, density_pixels);
    if (!command.masses.areEqual()) planWeights(plan, command.masses.file, work.sites);
    planSession(plan, work);
    const auto since = plan.next();
    plan.take("weights that are sought", of_any + of_newton * work.sites);
    if (work.backend != "cpu") plan.take("the driver", of_device);
    plan.drop(planCells(plan, work, Detail::polygons));
    plan.dropSince(since);
    planFiles(plan, work, command.targets, command.picture, domain);
  };
}

/// Rejects options that nothing uses, and sets the format of standard output.
Result<void> checkCommand(TransportCommand& command, const Invocation& how) {
  if (outputPaths(command).empty() && how.stats == nullptr) {
    return inputError(
        "-o: name what to write, as in -o sites.csv (or give --save-weights, --cells, --picture, --trace or "
        "--stats)");
  }
  VORPIPE_TRY(checkMasses(command.masses));
  if (!command.weights.empty()) {
    if (auto checked = checkWeightsPath(command.weights); !checked) {
      return named("--save-weights", std::move(checked.error()));
    }
  }
  return takeFormat(command.targets, command.input);
}

/// Returns the options of the transport, except the scale of its masses.
TransportOptions transportOptions(const TransportCommand& command, const Input& input, const Density& density,
                                  std::vector<double> masses) {
  TransportOptions options{};
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  options.density = density;
  options.surface = command.masses.around();
  options.search = command.search;
  options.masses = std::move(masses);
  options.tolerance = command.tolerance;
  options.diagrams = command.diagrams;
  options.progress = untilSignal();
  return options;
}

/// A run in progress.
struct TransportRun {
  const TransportCommand& command;
  const ResultJob& job;
  RunLog& log;
  std::vector<OutputFile> files{};
};

Result<Transported> transportIn(TransportRun& run, Session& session, TransportOptions options) {
  const auto count = run.job.input.sites.size();
  VORPIPE_TRY(fitMasses(run.command.masses, count, session, options));
  ProgressBar bar(run.command.talk.quiet);
  double first_worst = 0;
  return transport(session, run.job.input.sites, options, [&](const TransportStep& step) {
    if (!(first_worst > 0)) first_worst = step.worst;
    if (step.taken) {
      bar.show(fmt::format("transport {}, worst {:.2g}", step.diagram, step.worst),
               partDone(step, first_worst, options.tolerance));
    }
    return !!stopIfAsked();
  });
}

TransportFigures figuresOf(const TransportRun& run, const Transported& found) {
  const TransportStep& last = lastKept(found.trace);
  return {std::string(wordOf(found.end)),
          run.command.masses.around() == Surface::free,
          found.trace.size(),
          newtonSteps(found.trace),
          last,
          std::accumulate(found.cells.mass.begin(), found.cells.mass.end(), 0.0),
          found.cost};
}

Result<void> writeFiles(TransportRun& run, Session& session, const Transported& found, std::uint64_t forecast,
                        const Stopwatch& total) {
  const Stopwatch watch;
  const auto parts = partsOf(session, run.job, found.sites);
  if (!parts) return tl::unexpected(parts.error());
  std::vector<Writer> writers = writersOf(run.job, *parts);
  if (!run.command.weights.empty()) {
    writers.emplace_back(
        [&](ByteSink& to) { return writeWeights(to, found.sites.weight, run.command.weights); });
  }
  if (!run.job.targets.trace.empty()) {
    writers.emplace_back([&](ByteSink& to) {
      run.log.noteTimeless(traceText(found.trace, false));
      return to.write(traceText(found.trace, true));
    });
  }
  const auto json = [&] {
    Stats stats{"transport",          run.job.input,        found.report, run.log,
                watch.milliseconds(), total.milliseconds(), forecast};
    stats.area_sum = std::accumulate(found.cells.area.begin(), found.cells.area.end(), 0.0);
    stats.transport = figuresOf(run, found);
    if (!run.job.density.values.empty()) stats.mass_sum = stats.transport->mass;
    return statsJson(stats);
  };
  return writeOutputs(run.files, writers, run.log, json);
}

Result<ExitCode> transportCells(TransportCommand& command, const Invocation& how) {
  setDriverThreads(command.backend.threads);
  const Stopwatch total;
  RunLog log(how, !command.stats.empty());
  log.search = command.search;
  log.threads = command.backend.threads;
  VORPIPE_TRY(checkCommand(command, how));
  const auto density = densityOf(command.density);
  if (!density) return tl::unexpected(density.error());
  InputOptions reading = command.input;
  reading.reading.attributes = command.targets.carryAttributes() || wantsAttributes(command.masses);
  reading.reading.needed = neededFor(command.masses);
  auto input = inputUnder(*density, command.density, reading, planOf(command, density->density.values.size()),
                          command.memory_limit);
  if (!input) return tl::unexpected(input.error());
  auto masses = loadMasses(command.masses, *input);
  if (!masses) return tl::unexpected(std::move(masses.error()));
  TransportOptions options = transportOptions(command, *input, density->density, std::move(*masses));
  const ResultJob job{command.targets,  reading,        command.picture,         *input,
                      density->density, command.search, command.backend.threads, command.masses.around()};
  VORPIPE_TRY(checkBefore(job));
  printNotes(command.talk, *input);
  const auto paths = outputPaths(command);
  auto files = openOutputs(paths);
  if (!files) return tl::unexpected(std::move(files.error()));
  awaitResultOnSignals();
  auto session = Session::open(command.backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  log.choice = session->choice();
  const auto forecast =
      forecastRun(reading, *input, ImagesFor::cells, session->device(), command.backend,
                  planOf(command, density->density.values.size(), input->domain), command.memory_limit);
  if (!forecast) return tl::unexpected(forecast.error());
  TransportRun run{command, job, log, std::move(*files)};
  const auto found = transportIn(run, *session, std::move(options));
  if (!found) return asOption(withAdvice(found.error(), command.masses), reading);
  const bool interrupted = takeSignal();
  printNotes(command.talk, found->report);
  if (!validationIsSilent(found->report)) return exit_device;
  VORPIPE_TRY(writeFiles(run, *session, *found, *forecast, total));
  if (command.masses.around() == Surface::free && !command.targets.points.empty() && !command.talk.quiet) {
    printNote("-o: files of sites do not say that air is around their cells: have --surface free read them");
  }
  printSummary(command.talk, paths,
               fmt::format("{}, {}, {}\n", outcomeText(paths, found->sites, found->report), summaryOf(*found),
                           runText(found->report, total.milliseconds(), false)));
  if (command.talk.verbose && !log.choice.empty()) printNote(log.choice);
  return exitCodeOf(*found, interrupted);
}

void addSolverOptions(Options& options, TransportCommand& command) {
  options.group("Masses");
  addDensityOptions(options, command.density,
                    "masses are its integrals over cells. --sites density:N draws N sites from it");
  addParsed(options, "--tolerance", command.tolerance, "T",
            "ends when no cell differs from its mass by more than this part of it [1e-8]", parseTolerance);
  addParsed(options, "--diagrams", command.diagrams, "N", "the most diagrams to compute [400]",
            [](std::string_view text) { return parseWhole(text, 1, UINT32_MAX); });
}

void addTransportOutputs(Options& options, TransportCommand& command) {
  options.group("Output");
  addResultTargets(options, command.targets, "the sites with the weights that were found");
  addAnyFile(options, "--save-weights", command.weights, {".npy", ".csv", ".txt"},
             "the weights alone, for --weights: .npy, .csv or .txt");
  addFile(options, "--trace", command.targets.trace, ".csv",
          "a row for each diagram: its number, that of the Newton step, the part of it that was tried and "
          "whether it was kept, what is left as a norm and in the worst cell, the least mass, iterations of "
          "the linear solver, seconds");
}

}  // namespace

void addTransport(CommandLine& line) {
  auto command = std::make_shared<TransportCommand>();
  Options options =
      line.addSubcommand("transport", "finds the weights that give each cell a prescribed area or mass",
                         [command](const Invocation& how) { return transportCells(*command, how); });
  addInputOptions(options, command->input).required();
  addMassOptions(options, command->masses);
  addSolverOptions(options, *command);
  addTransportOutputs(options, *command);
  addPictureGroup(options, command->picture);
  addBackendChoice(options, command->backend);
  addSearchOptions(options, command->search);
  addRunOptions(options, command->backend, command->memory_limit);
  options.group("Output");
  addStats(options, command->stats);
  addTalkOptions(options, command->talk, command->backend.waiting);
}

}  // namespace vorpipe::cli
