#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/stopwatch.h"
#include "base/try.h"
#include "cli/commands/command.h"
#include "cli/drawing.h"
#include "cli/fluid_files.h"
#include "cli/options/error_line.h"
#include "cli/options/fluid_options.h"
#include "cli/options/picture_options.h"
#include "cli/progress.h"
#include "cli/run.h"
#include "io/base/error.h"
#include "io/cells/cells_file.h"
#include "io/cells/forecast_files.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {
namespace {

struct FluidCommand : RunOptions {
  FluidChoices choices;
  FluidTargets targets;
  PictureOptions picture;
};

/// Returns the measured bytes per cell besides the diagram: parcels, their masses and weights, the matrix of
/// Newton's steps and the levels of its solver. With projection also how areas change with velocities, and
/// discs.
std::uint64_t bytesOf(const FluidOptions& options) {
  constexpr std::uint64_t of_springs = 920, of_projection = 1300, of_surface = 1850, of_friction = 100,
                          of_centering = 50, of_polygons = 1300;
  const std::uint64_t extras =
      (options.viscosity != 0 ? of_friction : 0) + (options.centering != 0 ? of_centering : 0);
  if (options.surface == Surface::free) return of_surface + extras;
  if (options.periodic != Periodic::none || !options.outline.empty()) return of_polygons + extras;
  return (schemeOf(options) == FluidScheme::projection ? of_projection : of_springs) + extras;
}

std::string_view optionOf(const FluidChoices& choices) {
  if (!choices.resume.empty()) return "--resume";
  return fluidCaseOf(choices.begin) ? "--particles" : "--case";
}

/// Returns the peak memory, in bytes, of a fluid that takes `of_fluid` bytes per cell.
std::uint64_t peakOf(const FluidCommand& command, Workload work, std::uint64_t of_fluid,
                     const std::optional<Box>& domain) {
  constexpr std::uint64_t of_smallest = 12'000'000;
  work.weighted = true;
  MemoryPlan plan;
  planSession(plan, work);
  plan.take("the fluid", of_smallest + of_fluid * work.sites);
  plan.drop(planCells(plan, work, Detail::polygons));
  const FluidTargets& targets = command.targets;
  if (!targets.series.empty()) plan.drop(planCells(plan, work, Detail::polygons));
  if (!targets.frames.empty()) {
    planDrawingAfterSteps(plan, work, command.picture, domain, {.pixels = true, .cells = false});
  }
  if (!targets.cells.empty()) planCells(plan, work, Detail::everything);
  for (const CellsTarget& target : targets.cells) planCellsFile(plan, work, *target.format);
  return plan.peak();
}

/// Error (input): more than is available, or than the limit.
Result<std::uint64_t> allowed(const FluidCommand& command, std::uint64_t bytes) {
  const auto lack = lackOfMemory(bytes, command.memory_limit);
  if (lack) return inputError(fmt::format("{}: {}", optionOf(command.choices), *lack));
  return bytes;
}

/// Error (input): the cells of a named case will not fit on any device. Call before the case is made.
Result<void> forecastCase(const FluidCommand& command) {
  const FluidChoices& choices = command.choices;
  const auto which = fluidCaseOf(choices.begin);
  if (!choices.resume.empty() || !which) return {};
  // The options of a case do not depend on its number of parcels.
  FluidOptions options = fluidCase(*which, 64).options;
  takeGiven(choices, options);
  Workload work;
  work.sites = choices.particles.value_or(usualParcels(*which));
  work.periodic = options.periodic != Periodic::none;
  return allowed(command, peakOf(command, work, bytesOf(options), options.domain)).map([](std::uint64_t) {});
}

/// Returns the peak memory of a run, in bytes. Errors: those of allowed and workloadOf.
Result<std::uint64_t> forecastFluid(const FluidCommand& command, const FluidSetup& setup,
                                    const DeviceInfo& device) {
  const FluidOptions& options = setup.options;
  VORPIPE_LET(work, workloadOf(setup.state.sites, cellsOptionsOf(options), ImagesFor::cells, device,
                               command.backend.threads));
  return allowed(command, peakOf(command, work, bytesOf(options), options.domain));
}

/// Why a run ended.
enum class RunEnd : std::uint8_t { time, steps, seconds, areas, interrupted };

std::string_view endWordOf(RunEnd end) {
  constexpr std::array<std::string_view, 5> words{"time", "steps", "seconds", "areas", "interrupted"};
  return words[static_cast<std::size_t>(end)];
}

struct FluidOutcome {
  Input input;  ///< the resulting sites
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
Result<FluidOutcome> flow(const FluidCommand& command, CommandRun& run, FluidSetup setup,
                          FluidRecord& record) {
  Session& session = *run.session;
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
  VORPIPE_TRY(record.finish(run.log));
  outcome.input = inputOf(fluid->state(), options);
  outcome.has_exploded = fluid->hasExploded();
  outcome.epsilon = options.epsilon;
  outcome.report = fluid->report();
  return outcome;
}

/// Rejects options that nothing uses.
Result<void> checkCommand(const FluidCommand& command, const FluidSetup& setup, const CommandRun& run) {
  const FluidTargets& targets = command.targets;
  if (targets.checkpoint.empty() && targets.trace.empty() && targets.frames.empty() &&
      targets.series.empty()) {
    VORPIPE_TRY(
        run.needsOutput("sites.csv", "--cells, --trace, --frames, --series, --checkpoint or --stats"));
  }
  const bool by_flow = flowColorOf(setup.state, command.picture, targets.color) != view::FlowColor::none;
  if (!targets.frames.empty() && command.picture.render.legend && by_flow) {
    return inputError("--legend: colors by --flow-color have none");
  }
  return {};
}

Result<void> writeFiles(const FluidCommand& command, CommandRun& run, const FluidOptions& options,
                        const FluidOutcome& outcome) {
  const Sites& sites = outcome.input.sites;
  RunOutput output{outcome.input, outcome.report};
  Diagram cells;
  if (!command.targets.cells.empty()) {
    VORPIPE_VAR(found, cellsWith(options.surface, *run.session, sites, cellsOptionsOf(options)));
    cells = std::move(found);
  }
  for (const auto& target : command.targets.points) {
    output.writers.emplace_back(
        [&, format = target.format](ByteSink& to) { return writePoints(to, {sites}, *format); });
  }
  for (const CellsTarget& target : command.targets.cells) {
    output.writers.emplace_back([&, format = target.format](ByteSink& to) {
      return writeCells(to, {sites, cells}, *format);
    });
  }
  output.figures = [&](nlohmann::ordered_json& json) {
    const FluidStep &first = outcome.first, &last = outcome.last;
    nlohmann::ordered_json epsilon;
    if (schemeOf(options) == FluidScheme::springs) epsilon = outcome.epsilon;
    nlohmann::ordered_json error;
    if (last.velocity_error) error = *last.velocity_error;
    json["fluid"] = {{"scheme", nameOf(schemeOf(options))},
                     {"viscosity", options.viscosity},
                     {"walls", nameOf(options.walls)},
                     {"centering", options.centering},
                     {"epsilon", epsilon},
                     {"end", endWordOf(outcome.end)},
                     {"step", {first.step, last.step}},
                     {"time", {first.time, last.time}},
                     {"kinetic", {first.kinetic, last.kinetic}},
                     {"potential", {first.potential, last.potential}},
                     {"spring", {first.spring, last.spring}},
                     {"energy", {first.energy(), last.energy()}},
                     {"energy_drift", outcome.drift},
                     {"momentum", {last.momentum.x, last.momentum.y}},
                     {"worst_area", outcome.worst},
                     {"farthest", {first.farthest, last.farthest}},
                     {"velocity_error", error}};
  };
  return run.write(output);
}

std::string fluidSummary(const FluidOutcome& outcome, const FluidOptions& options) {
  const FluidStep &first = outcome.first, &last = outcome.last;
  const std::string error =
      last.velocity_error ? fmt::format(", velocities within {:.1e}", *last.velocity_error) : std::string();
  return fmt::format(
      "{} cells by {}, time {:.6g} after {} steps ({}), energy {:.6g} to {:.6g}, areas within {:.1e}{}",
      outcome.input.sites.size(), nameOf(schemeOf(options)), last.time, last.step - first.step,
      endWordOf(outcome.end), first.energy(), last.energy(), outcome.worst, error);
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

Result<ExitCode> fluid(const FluidCommand& command, const Invocation& how) {
  CommandRun run("fluid", command, how, command.targets.paths());
  VORPIPE_TRY(forecastCase(command));
  VORPIPE_VAR(setup, setupOf(command.choices));
  VORPIPE_TRY(checkCommand(command, setup, run));
  setup.options.search = command.search;
  setup.options.progress = untilSignal();
  const FluidOptions options = setup.options;
  VORPIPE_TRY(run.createFiles());
  VORPIPE_TRY(checkApart(command.targets, run.files));
  // A resumed run may write checkpoints to the file that it resumes from.
  const bool is_resumed = !command.choices.resume.empty();
  if (!is_resumed) {
    VORPIPE_TRY(checkNotRead(std::array{command.targets.checkpoint, command.targets.trace}));
  }
  awaitResultOnSignals();
  VORPIPE_TRY(run.openSession());
  const auto forecast = forecastFluid(command, setup, run.session->device());
  if (!forecast) return asFluidOption(forecast.error(), command.choices);
  run.forecast = *forecast;
  VORPIPE_VAR(record,
              FluidRecord::open(command.targets, command.picture, is_resumed ? &setup.state : nullptr));
  VORPIPE_LET(outcome, flow(command, run, std::move(setup), record));
  takeSignal();
  printNotes(command.talk, withNewNotes(outcome.report, outcome.told));
  if (!validationIsSilent(outcome.report)) return exit_device;
  VORPIPE_TRY(writeFiles(command, run, options, outcome));
  run.printSummary(fluidSummary(outcome, options), outcome.report);
  return exitFor(outcome);
}

}  // namespace

void addFluid(CommandLine& line) {
  auto command = std::make_shared<FluidCommand>();
  Options options = line.addSubcommand(
      "fluid", "a fluid whose cells keep their areas: vortices, falling columns, two fluids, viscous flows",
      [command](const Invocation& how) { return fluid(*command, how); });
  addFluidChoices(options, command->choices);
  options.group("Output");
  addFluidTargets(options, command->targets);
  options.group("Picture");
  addSizeOptions(options, command->picture);
  addColorOptions(options, command->picture.render);
  addFlowColor(options, command->targets.color);
  addMarkOptions(options, command->picture, LabelsOf::indices);
  addCommonOptions(options, *command);
}

}  // namespace vorpipe::cli
