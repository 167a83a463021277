#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "base/try.h"
#include "cli/commands/command.h"
#include "cli/options/error_line.h"
#include "cli/options/mass_options.h"
#include "cli/options/row_options.h"
#include "cli/progress.h"
#include "cli/result_files.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/cells/forecast_files.h"
#include "io/sites/weights_file.h"
#include "vorpipe/masses.h"

namespace vorpipe::cli {
namespace {

struct TransportCommand : SitesOptions {
  MassOptions masses;
  TransportOptions options{};
  std::set<std::string_view> given;  ///< names of given options
  std::string weights;               ///< a file
};

/// Plans the memory of a run: cells, the matrix and the levels of its solver, then files.
void planTransport(const TransportCommand& command, const SitesRun& run, MemoryPlan& plan, Workload work) {
  // As measured: weights and what is missing, the matrix and the levels of its solver; polygons of cells in
  // periods and outlines; what drivers keep from one diagram to the next.
  constexpr std::uint64_t of_any = 6'000'000, of_device = 8'000'000, in_box = 900, of_surface = 680,
                          of_polygons = 1360;
  const bool has_air = command.masses.around() == Surface::free;
  const auto of_newton = work.periodic || work.outlined ? of_polygons : has_air ? of_surface : in_box;
  work.weighted = true;
  run.planDensityOf(plan, work);
  if (!command.masses.areEqual()) planWeights(plan, command.masses.file, work.sites);
  planSession(plan, work);
  const auto since = plan.next();
  plan.take("weights that are sought", of_any + of_newton * work.sites);
  if (work.backend != "cpu") plan.take("the driver", of_device);
  plan.drop(planCells(plan, work, Detail::polygons));
  plan.dropSince(since);
  run.planFiles(plan, work);
}

/// Rejects options that nothing uses, and sets the format of standard output.
Result<void> checkCommand(TransportCommand& command, const SitesRun& run) {
  VORPIPE_TRY(run.needsOutput("sites.csv", "--save-weights, --cells, --picture, --trace or --stats"));
  VORPIPE_TRY(checkMasses(command.masses));
  if (!command.weights.empty()) {
    if (auto checked = checkWeightsPath(command.weights); !checked) {
      return named("--save-weights", std::move(checked.error()));
    }
  }
  return takeFormat(command.targets, command.input);
}

constexpr std::string_view skip_advice = "; --skip-zero leaves such sites out";

bool isOfZero(std::string_view message) { return message.find("is no mass") != std::string_view::npos; }

ZeroMass zeroOf(const MassOptions& masses) { return masses.skip_zero ? ZeroMass::taken : ZeroMass::refused; }

/// Returns advice on what unreadable masses may have meant.
std::string adviceOn(const Error& error, const MassOptions& masses, const Input& input) {
  const auto has_name = [&](const Attribute& attribute) { return attribute.name() == masses.file; };
  if (!masses.file.empty() && std::ranges::any_of(input.attributes, has_name)) {
    return fmt::format("; @{} is the attribute of the sites", masses.file);
  }
  return isOfZero(error.message) ? std::string(skip_advice) : "";
}

/// Removes the sites whose mass is 0.
Result<void> skipZero(std::vector<double>& masses, Input& input) {
  std::vector<bool> kept;
  for (const double mass : masses) kept.push_back(mass > 0);
  const auto zeros = std::erase(masses, 0.0);
  if (zeros == 0) return {};
  if (masses.empty()) return inputError("--masses: no site has any");
  input.notes.push_back(
      fmt::format("--skip-zero: {} of {} sites, whose mass is 0, are left out", zeros, input.sites.size()));
  keepSites(input, input.attributes, kept);
  return {};
}

/// Whether masses need attributes: one is named, or the given file name looks like one.
bool wantsAttributes(const MassOptions& masses) {
  return !masses.attribute.empty() || (!masses.file.empty() && inputExtension(masses.file).empty());
}

/// Returns the attribute that holds the masses, so that readers can locate a wrong one; none if there is no
/// such attribute.
std::optional<NeededAttribute> neededFor(const MassOptions& masses) {
  if (masses.attribute.empty()) return std::nullopt;
  return NeededAttribute{masses.attribute, [zero = zeroOf(masses)](std::string_view text) {
                           return checkMass(text, zero).map_error([](std::string what) {
                             return isOfZero(what) ? what.append(skip_advice) : what;
                           });
                         }};
}

/// Reads the masses; none if they are equal. If requested, removes sites without mass from the input.
Result<std::vector<double>> loadMasses(const MassOptions& masses, Input& input) {
  if (masses.areEqual()) return {};
  const ZeroMass zero = zeroOf(masses);
  auto read = masses.file.empty() ? massesIn(input.attributes, masses.attribute, zero)
                                  : readMasses(masses.file, input.sites.size(), zero);
  if (!read) {
    read.error().message += adviceOn(read.error(), masses, input);
    return named("--masses", std::move(read.error()));
  }
  if (masses.skip_zero) {
    VORPIPE_TRY(skipZero(*read, input));
  }
  return read;
}

/// Returns the options of the transport; fits the scale of the masses if that is requested.
Result<TransportOptions> transportOptions(const TransportCommand& command, SitesRun& run,
                                          std::vector<double> masses) {
  TransportOptions options = command.options;
  options.domain = run.input->domain;
  options.outline = run.input->outline;
  options.periodic = run.input->periodic;
  options.density = run.density.density;
  options.surface = run.surface;
  options.search = command.search;
  options.masses = std::move(masses);
  options.progress = untilSignal();
  if (!command.masses.normalize && !command.masses.fill) return options;
  VORPIPE_TRY(fillDomain(*run.session, run.input->sites.size(), command.masses.fill.value_or(1), options));
  return options;
}

/// Returns how far a step's worst cell has come from the first step's error to the tolerance, on a
/// logarithmic scale.
double partDone(const TransportStep& step, double first_worst, double tolerance) {
  const double way = std::log(first_worst / tolerance), done = std::log(first_worst / step.worst);
  return std::isfinite(done) && way > 0 ? std::clamp(done / way, 0.0, 1.0) : 0;
}

Result<Transported> transportSites(const TransportCommand& command, SitesRun& run,
                                   std::vector<double> masses) {
  VORPIPE_LET(options, transportOptions(command, run, std::move(masses)));
  ProgressBar bar(command.talk.quiet);
  double first_worst = 0;
  return transport(*run.session, run.input->sites, options, [&](const TransportStep& step) {
    if (!(first_worst > 0)) first_worst = step.worst;
    if (step.taken) {
      bar.show(fmt::format("transport {}, worst {:.2g}", step.diagram, step.worst),
               partDone(step, first_worst, command.options.tolerance));
    }
    return !!stopIfAsked();
  });
}

/// Returns the last kept step; the last step if none was kept.
const TransportStep& lastKept(const std::vector<TransportStep>& trace) {
  const auto kept = std::find_if(trace.rbegin(), trace.rend(), [](const auto& step) { return step.taken; });
  return kept == trace.rend() ? trace.back() : *kept;
}

/// Returns the number of attempted Newton steps.
std::uint64_t newtonSteps(const std::vector<TransportStep>& trace) {
  std::uint64_t most = 0;
  for (const TransportStep& step : trace) most = std::max(most, step.newton);
  return most;
}

/// Adds advice to an error. Masses that were read are finite and one per site, so only their sum can be
/// wrong.
Error withAdvice(Error error, const MassOptions& masses) {
  if (error.subject == Subject::masses && !masses.areEqual()) {
    error.message +=
        masses.around() == Surface::free ? "; --fill V scales them" : "; --normalize scales them";
  }
  return error;
}

/// Returns e.g. "worst cell off by 1e-13 of its mass after 6 Newton steps, 7 diagrams (converged)".
std::string summaryOf(const Transported& found) {
  return fmt::format("worst cell off by {:.3g} of its mass after {} Newton steps, {} diagrams ({})",
                     lastKept(found.trace).worst, newtonSteps(found.trace), found.trace.size(),
                     nameOf(found.end));
}

/// Returns the exit code. Prints how the run ended if it did not reach the tolerance.
ExitCode exitCodeOf(const Transported& found, bool interrupted) {
  const TransportStep& last = lastKept(found.trace);
  const std::string reached = fmt::format(
      "the files have what was reached after {} diagrams, the worst cell off by {:.3g} of its mass",
      found.trace.size(), last.worst);
  if (interrupted) {
    printError(fmt::format("interrupted: {}", reached));
    return static_cast<ExitCode>(signalExitCode());
  }
  if (found.end == TransportEnd::converged) return exit_done;
  const std::string_view why =
      found.end == TransportEnd::diagrams ? "no more are allowed by --diagrams" : "rounding allows no more";
  printError(fmt::format("not converged: {}; {}", reached, why));
  return exit_different;
}

/// Returns the rows of --trace; without `with_times`, only what is the same in every run.
std::string traceText(const std::vector<TransportStep>& trace, bool with_times) {
  std::string text = "diagram,newton,length,taken,norm,worst,least,linear_iterations,seconds\n";
  const auto to = std::back_inserter(text);
  // A value that is not finite was not measured: a cell was empty.
  const auto put = [&](double value) {
    if (std::isfinite(value)) fmt::format_to(to, "{}", value);
    text += ',';
  };
  for (const TransportStep& step : trace) {
    fmt::format_to(to, "{},{},{},{},", step.diagram, step.newton, step.length, step.taken ? 1 : 0);
    put(step.norm);
    put(step.worst);
    put(step.least);
    fmt::format_to(to, "{},", step.linear_iterations);
    if (with_times) fmt::format_to(to, "{:.6f}", step.seconds);
    text += '\n';
  }
  return text;
}

Result<void> writeFiles(const TransportCommand& command, SitesRun& run, const Transported& found) {
  RunOutput output{*run.input, found.report};
  if (!command.weights.empty()) {
    output.writers.emplace_back(
        [&](ByteSink& to) { return writeWeights(to, found.sites.weight, command.weights); });
  }
  if (!command.targets.trace.empty()) output.writers.push_back(traceWriter(run.log, found.trace, traceText));
  output.figures = [&](nlohmann::ordered_json& json) {
    const TransportStep& last = lastKept(found.trace);
    const double mass = std::accumulate(found.cells.mass.begin(), found.cells.mass.end(), 0.0);
    json["area_sum"] = std::accumulate(found.cells.area.begin(), found.cells.area.end(), 0.0);
    if (!run.density.density.values.empty()) json["mass_sum"] = mass;
    nlohmann::ordered_json surface;
    if (run.surface == Surface::free) surface = "free";
    json["transport"] = {{"surface", surface},
                         {"diagrams", found.trace.size()},
                         {"newton", newtonSteps(found.trace)},
                         {"end", nameOf(found.end)},
                         {"worst", last.worst},
                         {"norm", last.norm},
                         {"mass", mass},
                         {"cost", found.cost}};
  };
  return run.write(found.sites, std::move(output));
}

Result<ExitCode> transportCells(TransportCommand& command, const Invocation& how) {
  SitesRun run("transport", command, how,
               command.targets.pathsWith({command.weights, command.targets.trace}));
  VORPIPE_TRY(checkCommand(command, run));
  run.source.reading.attributes = command.targets.carryAttributes() || wantsAttributes(command.masses) ||
                                  needsAttributes(command.picture);
  run.source.reading.needed = neededFor(command.masses);
  run.surface = command.masses.around();
  const PlanRun plan = std::bind_front(planTransport, std::cref(command), std::cref(run));
  VORPIPE_TRY(run.load(plan));
  VORPIPE_VAR(masses, loadMasses(command.masses, *run.input));
  VORPIPE_TRY(run.begin(plan));
  const auto found = transportSites(command, run, std::move(masses));
  if (!found) return asOption(withAdvice(found.error(), command.masses), run.source);
  const bool interrupted = takeSignal();
  printNotes(command.talk, found->report);
  if (!validationIsSilent(found->report)) return exit_device;
  VORPIPE_TRY(writeFiles(command, run, *found));
  if (run.surface == Surface::free && !command.targets.points.empty() && !command.talk.quiet) {
    printNote("-o: files of sites do not say that air is around their cells: have --surface free read them");
  }
  run.printSummary(fmt::format("{}, {}", run.outcome(found->sites, found->report), summaryOf(*found)),
                   found->report);
  return exitCodeOf(*found, interrupted);
}

void addSolverOptions(Options& options, TransportCommand& command) {
  options.group("Masses");
  addDensityOptions(options, command.density,
                    "masses are its integrals over cells. --sites density:N draws N sites from it");
  forEachRow(transport_rows, [&](const auto& row) { addRow(options, row, command.options, command.given); });
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
  addCommonOptions(options, *command);
}

}  // namespace vorpipe::cli
