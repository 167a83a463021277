#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>

#include "base/stopwatch.h"
#include "base/try.h"
#include "bench/driver_threads.h"
#include "cli/commands/command.h"
#include "cli/fluid_files.h"
#include "cli/fluid_plan.h"
#include "cli/input.h"
#include "cli/options/error_line.h"
#include "cli/options/fluid_options.h"
#include "cli/options/options.h"
#include "cli/options/picture_options.h"
#include "cli/picture.h"
#include "cli/progress.h"
#include "cli/run_end.h"
#include "cli/stats.h"
#include "io/base/error.h"
#include "io/cells/cells_file.h"
#include "vorpipe/fluid.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::cli {
namespace {

struct FluidCommand {
  FluidChoices choices;
  FluidTargets targets;
  BackendOptions backend;
  TalkOptions talk;
  SearchOptions search;
  PictureOptions picture;
  std::optional<std::uint64_t> memory_limit;
};

/// Why a run ended.
enum class RunEnd : std::uint8_t { time, steps, seconds, areas, interrupted };

std::string_view endWordOf(RunEnd end) {
  constexpr std::array<std::string_view, 5> words{"time", "steps", "seconds", "areas", "interrupted"};
  return words[static_cast<std::size_t>(end)];
}

struct FluidOutcome {
  FluidState state;
  FluidStep first, last;
  double worst = 0, drift = 0;  ///< the largest over all steps
  RunEnd end = RunEnd::time;
  bool has_exploded = false;
  double epsilon = 0;
  Report report;
  std::vector<std::string> told;  ///< notes printed before the first step
};

Result<void> note(const FluidStep& step, FluidOutcome& outcome, FluidRecord& record) {
  outcome.last = step;
  outcome.worst = std::max(outcome.worst, step.worst);
  const double scale = std::max(std::abs(outcome.first.energy()), outcome.first.kinetic);
  if (scale > 0) {
    outcome.drift = std::max(outcome.drift, std::abs(step.energy() - outcome.first.energy()) / scale);
  }
  return record.addRow(step);
}

/// Returns why the options end the run before its next step; none if they do not.
std::optional<RunEnd> endedBy(const FluidChoices& choices, const FluidOutcome& outcome,
                              const Stopwatch& watch) {
  if (choices.steps && outcome.last.step - outcome.first.step >= *choices.steps) return RunEnd::steps;
  if (choices.seconds && watch.seconds() >= *choices.seconds) return RunEnd::seconds;
  return std::nullopt;
}

RunEnd endOf(FluidEnd end) {
  if (end == FluidEnd::cancelled) return RunEnd::interrupted;
  return end == FluidEnd::areas ? RunEnd::areas : RunEnd::time;
}

/// Returns the report with only the notes not printed before, in the words of the command line.
Report withNewNotes(Report report, const std::vector<std::string>& told) {
  std::erase_if(report.notes,
                [&](const std::string& note) { return std::ranges::find(told, note) != told.end(); });
  for (std::string& note : report.notes) {
    if (note.starts_with("step:") || note.starts_with("epsilon:")) note.insert(0, "--");
  }
  return report;
}

/// Makes the steps, and writes the files that grow during the run.
Result<FluidOutcome> flow(const FluidCommand& command, Session& session, FluidSetup setup,
                          FluidRecord& record, RunLog& log) {
  const Stopwatch watch;
  ProgressBar bar(command.talk.quiet);
  const double start = setup.state.time;
  auto fluid = Fluid::begin(session, std::move(setup.state), std::move(setup.options));
  if (!fluid) return asFluidOption(std::move(fluid.error()), command.choices);
  const FluidOptions& options = fluid->options();
  // Prints initial notes before a long run.
  FluidOutcome outcome;
  printNotes(command.talk, withNewNotes(fluid->report(), {}));
  outcome.told = fluid->report().notes;
  outcome.first = fluid->last();
  VORPIPE_TRY(note(fluid->last(), outcome, record));
  std::uint64_t recorded = outcome.last.step;
  VORPIPE_TRY(record.add(session, fluid->state(), options));
  for (;;) {
    if (const auto end = endedBy(command.choices, outcome, watch)) {
      outcome.end = *end;
      break;
    }
    const auto more = fluid->step();
    if (!more) return asFluidOption(more.error(), command.choices);
    if (!*more) {
      outcome.end = endOf(fluid->end());
      break;
    }
    VORPIPE_TRY(note(fluid->last(), outcome, record));
    bar.show(fmt::format("fluid, step {}, time {:.4g}", outcome.last.step, outcome.last.time),
             std::isfinite(options.until) ? (outcome.last.time - start) / (options.until - start) : 0);
    if (outcome.last.step % command.targets.every != 0) continue;
    recorded = outcome.last.step;
    VORPIPE_TRY(record.add(session, fluid->state(), options));
  }
  if (recorded != outcome.last.step) {
    VORPIPE_TRY(record.add(session, fluid->state(), options));
  }
  VORPIPE_TRY(record.finish(log));
  outcome.state = fluid->state();
  outcome.has_exploded = fluid->hasExploded();
  outcome.epsilon = options.epsilon;
  outcome.report = fluid->report();
  return outcome;
}

/// Rejects options that nothing uses.
Result<void> checkCommand(const FluidCommand& command, const FluidSetup& setup, const Invocation& how) {
  const FluidTargets& targets = command.targets;
  if (targets.paths().empty() && targets.checkpoint.empty() && targets.trace.empty() &&
      targets.frames.empty() && targets.series.empty() && how.stats == nullptr) {
    return inputError(
        "-o: name what to write, as in -o sites.csv (or give --cells, --trace, --frames, --series, "
        "--checkpoint or --stats)");
  }
  const bool by_flow = flowColorOf(setup.state, command.picture, targets.color) != view::FlowColor::none;
  if (!targets.frames.empty() && command.picture.render.legend && by_flow) {
    return inputError("--legend: colors by --flow-color have none");
  }
  return {};
}

Result<void> writeFiles(const FluidCommand& command, const FluidOptions& options, Session& session,
                        const FluidOutcome& outcome, std::vector<OutputFile>& files, RunLog& log,
                        std::uint64_t forecast, const Stopwatch& total) {
  const Stopwatch watch;
  Diagram cells;
  if (!command.targets.cells.empty()) {
    CellsOptions how{};
    how.domain = options.domain;
    how.periodic = options.periodic;
    how.search = options.search;
    auto found = options.surface == Surface::free ? freeCells(session, outcome.state.sites, how)
                                                  : session.cells(outcome.state.sites, how);
    if (!found) return tl::unexpected(std::move(found.error()));
    cells = std::move(*found);
  }
  std::vector<Writer> writers;
  for (const auto& target : command.targets.points) {
    writers.emplace_back([&, format = target.format](ByteSink& to) {
      return writePoints(to, {outcome.state.sites}, *format);
    });
  }
  for (const CellsTarget& target : command.targets.cells) {
    writers.emplace_back([&, format = target.format](ByteSink& to) {
      return writeCells(to, {outcome.state.sites, cells}, *format);
    });
  }
  const auto json = [&] {
    Input input{};
    input.sites = outcome.state.sites;
    input.domain = options.domain;
    input.periodic = options.periodic;
    Stats stats{"fluid", input, outcome.report, log, watch.milliseconds(), total.milliseconds(), forecast};
    stats.fluid = FluidFigures{std::string(nameOf(options.scheme)),
                               std::string(endWordOf(outcome.end)),
                               outcome.first,
                               outcome.last,
                               outcome.worst,
                               outcome.drift,
                               outcome.epsilon};
    return statsJson(stats);
  };
  return writeOutputs(files, writers, log, json);
}

std::string fluidSummary(const FluidOutcome& outcome, const FluidOptions& options) {
  const FluidStep &first = outcome.first, &last = outcome.last;
  return fmt::format(
      "{} cells by {}, time {:.6g} after {} steps ({}), energy {:.6g} to {:.6g}, areas within {:.1e}",
      outcome.state.sites.size(), nameOf(options.scheme), last.time, last.step - first.step,
      endWordOf(outcome.end), first.energy(), last.energy(), outcome.worst);
}

/// Returns the exit code, and prints an error for an unwanted end.
ExitCode exitFor(const FluidOutcome& outcome) {
  if (outcome.end == RunEnd::interrupted) {
    printError(fmt::format("interrupted: the files have the fluid after step {}", outcome.last.step));
    return static_cast<ExitCode>(signalExitCode());
  }
  if (outcome.has_exploded) {
    printError(fmt::format(
        "energy has exploded, from {:.3g} to {:.3g}: the files have the fluid at time {}; a smaller --step "
        "is needed",
        outcome.first.energy(), outcome.last.energy(), outcome.last.time));
    return exit_different;
  }
  if (outcome.end != RunEnd::areas) return exit_done;
  printError(fmt::format(
      "areas could not be found after step {}, at time {}: the files have the fluid then; a smaller --step "
      "or a larger --epsilon may help",
      outcome.last.step, outcome.last.time));
  return exit_different;
}

Result<ExitCode> fluid(FluidCommand& command, const Invocation& how) {
  setDriverThreads(command.backend.threads);
  const Stopwatch total;
  RunLog log(how, !command.targets.stats.empty());
  log.search = command.search;
  log.threads = command.backend.threads;
  const FluidPlan plan{command.choices, command.targets, command.picture, command.memory_limit};
  VORPIPE_TRY(forecastCase(plan));
  auto setup = setupOf(command.choices);
  if (!setup) return tl::unexpected(std::move(setup.error()));
  VORPIPE_TRY(checkCommand(command, *setup, how));
  setup->options.search = command.search;
  setup->options.progress = untilSignal();
  const FluidOptions options = setup->options;
  auto files = openOutputs(command.targets.paths());
  if (!files) return tl::unexpected(std::move(files.error()));
  VORPIPE_TRY(checkApart(command.targets, *files));
  // A resumed run may write checkpoints to the file that it resumes from.
  if (command.choices.resume.empty()) {
    for (const std::string& path : {command.targets.checkpoint, command.targets.trace}) {
      VORPIPE_TRY(checkNotRead(std::span(&path, 1)));
    }
  }
  awaitResultOnSignals();
  auto session = Session::open(command.backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  log.choice = session->choice();
  const auto forecast = forecastFluid(plan, *setup, session->device(), command.backend.threads);
  if (!forecast) return asFluidOption(forecast.error(), command.choices);
  auto record = FluidRecord::open(command.targets, command.picture,
                                  command.choices.resume.empty() ? nullptr : &setup->state);
  if (!record) return tl::unexpected(std::move(record.error()));
  const auto outcome = flow(command, *session, std::move(*setup), *record, log);
  if (!outcome) return tl::unexpected(std::move(outcome.error()));
  takeSignal();
  printNotes(command.talk, withNewNotes(outcome->report, outcome->told));
  if (!validationIsSilent(outcome->report)) return exit_device;
  VORPIPE_TRY(writeFiles(command, options, *session, *outcome, *files, log, *forecast, total));
  printSummary(command.talk, command.targets.paths(),
               fmt::format("{}, {}\n", fluidSummary(*outcome, options),
                           runText(outcome->report, total.milliseconds(), false)));
  if (command.talk.verbose && !log.choice.empty()) printNote(log.choice);
  return exitFor(*outcome);
}

}  // namespace

void addFluid(CommandLine& line) {
  auto command = std::make_shared<FluidCommand>();
  Options options = line.addSubcommand(
      "fluid", "a fluid without friction whose cells keep their areas: vortices, falling columns, two fluids",
      [command](const Invocation& how) { return fluid(*command, how); });
  addFluidChoices(options, command->choices);
  options.group("Output");
  addFluidTargets(options, command->targets);
  options.group("Picture");
  addSizeOptions(options, command->picture);
  addColorOptions(options, command->picture.render);
  addFlowColor(options, command->targets.color);
  addMarkOptions(options, command->picture);
  addBackendChoice(options, command->backend);
  addSearchOptions(options, command->search);
  addRunOptions(options, command->backend, command->memory_limit);
  options.group("Output");
  addStats(options, command->targets.stats);
  addTalkOptions(options, command->talk, command->backend.waiting);
}

}  // namespace vorpipe::cli
