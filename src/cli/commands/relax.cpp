#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
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
#include "cli/options/options.h"
#include "cli/options/picture_options.h"
#include "cli/options/result_outputs.h"
#include "cli/progress.h"
#include "cli/result_files.h"
#include "cli/run_end.h"
#include "cli/stats.h"
#include "io/base/error.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/cells/forecast_files.h"
#include "vorpipe/stipple.h"

namespace vorpipe::cli {
namespace {

struct RelaxCommand {
  InputOptions input;
  BackendOptions backend;
  TalkOptions talk;
  SearchOptions search;
  PictureOptions picture;
  RelaxMethod method = RelaxMethod::lbfgs;
  std::uint64_t iterations = 50;
  double tolerance = 0;
  bool equal_masses = false;
  ResultTargets targets;
  DensityOptions density;
  std::string stats;
  std::optional<std::uint64_t> memory_limit;
};

std::vector<std::string> methodNames() { return {"lbfgs", "lloyd"}; }

Parsed<RelaxMethod> parseMethod(std::string_view text) {
  if (text == "lbfgs") return RelaxMethod::lbfgs;
  if (text == "lloyd") return RelaxMethod::lloyd;
  return tl::unexpected(fmt::format("{} is not {}", inQuotes(text), anyOf(methodNames())));
}

Parsed<double> parseMoveTolerance(std::string_view text) {
  const auto number = parseNumber(text);
  if (!number) return tl::unexpected(number.error());
  if (*number >= 0) return *number;
  return tl::unexpected(fmt::format("{} is not a number of 0 or more", *number));
}

/// Returns the requested output files, in the order in which they are created.
std::vector<std::string> outputPaths(const RelaxCommand& command) {
  return command.targets.pathsWith({command.targets.trace, command.stats});
}

std::string_view endWordOf(RelaxEnd end) {
  constexpr std::array<std::string_view, 4> words{"iterations", "tolerance", "stagnated", "cancelled"};
  return words[static_cast<std::size_t>(end)];
}

/// Returns the memory plan of a run: sites and steps besides the cells of a diagram, then files; `domain` if
/// known.
PlanRun planOf(const RelaxCommand& command, std::uint64_t density_pixels,
               const std::optional<Box>& domain = {}) {
  return [&command, density_pixels, domain](MemoryPlan& plan, Workload work) {
    constexpr std::uint64_t number = sizeof(double), steps_of_newton = 14, others = 12;
    work.density_pixels = density_pixels;
    if (density_pixels > 0) planDensity(plan, density_pixels);
    planSession(plan, work);
    const auto since = plan.next();
    const bool newton = command.method == RelaxMethod::lbfgs;
    plan.take("sites that move", (others + (newton ? steps_of_newton : 0)) * 2 * number * work.sites);
    plan.drop(planCells(plan, work, Detail::polygons));
    plan.dropSince(since);
    planFiles(plan, work, command.targets, command.picture, domain);
  };
}

/// A run in progress.
struct RelaxRun {
  const RelaxCommand& command;
  ResultJob job;
  RunLog& log;
  std::vector<OutputFile> files{};
};

/// Writes the numbered files of a diagram.
Result<void> saveNumbered(RelaxRun& run, Session& session, const Relaxation& relaxation) {
  const auto parts = partsOf(session, run.job, relaxation.sites());
  if (!parts) return tl::unexpected(parts.error());
  const auto paths = run.job.targets.numberedPaths(relaxation.trace().back().diagram);
  auto numbered = createOutputs(paths, run.files);
  if (!numbered) return tl::unexpected(std::move(numbered.error()));
  const auto writers = writersOf(run.job, *parts);
  for (std::size_t k = 0; k < writers.size(); ++k) {
    VORPIPE_TRY(run.log.noteOutput((*numbered)[k], writers[k]));
  }
  return commitAll(*numbered);
}

/// Returns e.g. "relax 12/50, 1.0334".
std::string progressText(std::uint64_t diagram, const RelaxStep& step, std::uint64_t iterations) {
  const std::string at = fmt::format("relax {}/{}", diagram, iterations);
  return std::isfinite(step.hexagonal) ? fmt::format("{}, {:.4f}", at, step.hexagonal)
                                       : fmt::format("{}, {:.6g}", at, step.energy);
}

Result<Relaxed> relaxIn(RelaxRun& run, Session& session, RelaxOptions options) {
  ProgressBar bar(run.command.talk.quiet);
  const std::uint64_t every = run.job.targets.every;
  const auto whole = static_cast<double>(std::max<std::uint64_t>(options.iterations, 1));
  const auto iterations = options.iterations;
  auto relaxation = Relaxation::begin(session, run.job.input.sites, std::move(options));
  if (!relaxation) return tl::unexpected(std::move(relaxation.error()));
  Result<bool> more = true;
  while (more && *more) {
    const std::uint64_t diagram = relaxation->trace().back().diagram;
    bar.show(progressText(diagram, lastTaken(relaxation->trace()), iterations),
             static_cast<double>(diagram) / whole);
    if (every > 0 && diagram % every == 0) {
      VORPIPE_TRY(saveNumbered(run, session, *relaxation));
    }
    more = relaxation->step();
  }
  if (!more) return tl::unexpected(more.error());
  return Relaxed{relaxation->sites(), relaxation->trace(), relaxation->end(), relaxation->report()};
}

/// Returns the options of the relaxation, except the progress.
RelaxOptions relaxOptions(const RelaxCommand& command, const Input& input, const Density& density) {
  RelaxOptions options{};
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  options.density = density;
  options.equal_masses = command.equal_masses;
  options.search = command.search;
  options.method = command.method;
  options.iterations = command.iterations;
  options.tolerance = command.tolerance;
  options.progress = untilSignal();
  return options;
}

std::string relaxSummary(const Relaxed& relaxed) {
  const RelaxStep &first = relaxed.trace.front(), &last = lastTaken(relaxed.trace);
  std::string text = fmt::format("energy {:.6g} to {:.6g}", first.energy, last.energy);
  if (std::isfinite(last.hexagonal)) {
    text += fmt::format(" ({:.4f} to {:.4f} of the hexagonal lattice's)", first.hexagonal, last.hexagonal);
  }
  return text + fmt::format(" after {} diagrams ({})", relaxed.trace.back().diagram, endWordOf(relaxed.end));
}

Result<void> writeFiles(RelaxRun& run, Session& session, const Relaxed& relaxed, std::uint64_t forecast,
                        const Stopwatch& total) {
  const Stopwatch watch;
  const auto parts = partsOf(session, run.job, relaxed.sites);
  if (!parts) return tl::unexpected(parts.error());
  std::vector<Writer> writers = writersOf(run.job, *parts);
  if (!run.job.targets.trace.empty()) {
    writers.emplace_back([&](ByteSink& to) {
      run.log.noteTimeless(traceText(relaxed.trace, false));
      return to.write(traceText(relaxed.trace, true));
    });
  }
  const auto json = [&] {
    Stats stats{"relax", run.job.input, relaxed.report, run.log, watch.milliseconds(), total.milliseconds(),
                forecast};
    if (parts->cells) stats.area_sum = areaSum(*parts->cells);
    if (parts->cells && !parts->cells->mass.empty()) {
      stats.mass_sum = std::accumulate(parts->cells->mass.begin(), parts->cells->mass.end(), 0.0);
    }
    stats.relaxation = RelaxFigures{run.command.method == RelaxMethod::lloyd ? "lloyd" : "lbfgs",
                                    std::string(endWordOf(relaxed.end)), relaxed.trace.size(),
                                    relaxed.trace.front(), lastTaken(relaxed.trace)};
    return statsJson(stats);
  };
  return writeOutputs(run.files, writers, run.log, json);
}

/// Rejects options that nothing uses, and sets the format of standard output.
Result<void> checkCommand(RelaxCommand& command, const Invocation& how) {
  if (outputPaths(command).empty() && how.stats == nullptr) {
    return inputError(
        "-o: name what to write, as in -o sites.csv (or give --cells, --picture, --trace or --stats)");
  }
  if (command.equal_masses && command.density.empty()) {
    return inputError("--equal-masses: is for a --density; without one masses are areas");
  }
  return takeFormat(command.targets, command.input);
}

Result<ExitCode> relax(RelaxCommand& command, const Invocation& how) {
  setDriverThreads(command.backend.threads);
  const Stopwatch total;
  RunLog log(how, !command.stats.empty());
  log.search = command.search;
  log.threads = command.backend.threads;
  VORPIPE_TRY(checkCommand(command, how));
  const auto density = densityOf(command.density);
  if (!density) return tl::unexpected(density.error());
  InputOptions reading = command.input;
  reading.reading.attributes = command.targets.carryAttributes();
  const auto input = inputUnder(*density, command.density, reading,
                                planOf(command, density->density.values.size()), command.memory_limit);
  if (!input) return tl::unexpected(input.error());
  RelaxOptions options = relaxOptions(command, *input, density->density);
  const ResultJob job{command.targets,  reading,        command.picture,        *input,
                      density->density, command.search, command.backend.threads};
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
  RelaxRun run{command, job, log, std::move(*files)};
  const auto relaxed = relaxIn(run, *session, std::move(options));
  if (!relaxed) return asOption(relaxed.error(), reading);
  const bool interrupted = takeSignal();
  printNotes(command.talk, relaxed->report);
  if (!validationIsSilent(relaxed->report)) return exit_device;
  VORPIPE_TRY(writeFiles(run, *session, *relaxed, *forecast, total));
  printSummary(command.talk, paths,
               fmt::format("{}, {}, {}\n", outcomeText(paths, relaxed->sites, relaxed->report),
                           relaxSummary(*relaxed), runText(relaxed->report, total.milliseconds(), false)));
  if (command.talk.verbose && !log.choice.empty()) printNote(log.choice);
  if (!interrupted) return exit_done;
  printError(
      fmt::format("interrupted: the files have the sites after {} diagrams", relaxed->trace.back().diagram));
  return static_cast<ExitCode>(signalExitCode());
}

void addMethodOptions(Options& options, RelaxCommand& command) {
  options.group("Relaxation");
  addParsed(
      options, "--method", command.method, "NAME",
      "how sites move: lbfgs, which comes as far in 30 diagrams as Lloyd's steps in 200; or lloyd, each to "
      "the centroid of its cell [lbfgs]",
      parseMethod, {methodNames(), {}});
  addParsed(options, "--iterations", command.iterations, "N",
            "the most diagrams to compute after the first [50]",
            [](std::string_view text) { return parseWhole(text, 0, UINT32_MAX); });
  addParsed(options, "--tolerance", command.tolerance, "T",
            "ends when no site would move farther than this part of the spacing, the square root of the mean "
            "area [0: never]",
            parseMoveTolerance);
  addDensityOptions(options, command.density,
                    "sites gather where it is high. --sites density:N draws N sites from it, as dense as it "
                    "is, in the box of its pixels where no --domain is named");
  options.addFlag("--equal-masses", command.equal_masses,
                  "relaxes under the square of the density: then cells get equal masses, as stippling "
                  "wants it; else sites are as dense as its square root");
}

}  // namespace

void addRelax(CommandLine& line) {
  auto command = std::make_shared<RelaxCommand>();
  Options options = line.addSubcommand(
      "relax", "moves sites until each is the centroid of its cell; under a density, as in stippling",
      [command](const Invocation& how) { return relax(*command, how); });
  addInputOptions(options, command->input).required();
  addMethodOptions(options, *command);
  options.group("Output");
  addRelaxTargets(options, command->targets);
  addPictureGroup(options, command->picture);
  addBackendChoice(options, command->backend);
  addSearchOptions(options, command->search);
  addRunOptions(options, command->backend, command->memory_limit);
  options.group("Output");
  addStats(options, command->stats);
  addTalkOptions(options, command->talk, command->backend.waiting);
}

}  // namespace vorpipe::cli
