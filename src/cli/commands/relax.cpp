#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "base/try.h"
#include "cli/commands/command.h"
#include "cli/options/error_line.h"
#include "cli/options/row_options.h"
#include "cli/progress.h"
#include "cli/result_files.h"
#include "io/base/error.h"

namespace vorpipe::cli {
namespace {

struct RelaxCommand : SitesOptions {
  RelaxOptions options{};
  std::set<std::string_view> given;  ///< names of given options
};

/// Plans the memory of a run: sites and steps besides the cells of a diagram, then files.
void planRelaxation(const RelaxCommand& command, const SitesRun& run, MemoryPlan& plan, Workload work) {
  constexpr std::uint64_t number = sizeof(double), steps_of_newton = 14, others = 12;
  run.planDensityOf(plan, work);
  planSession(plan, work);
  const auto since = plan.next();
  const bool newton = command.options.method == RelaxMethod::lbfgs;
  const std::uint64_t axes = command.input.globe ? 3 : 2;
  plan.take("sites that move", (others + (newton ? steps_of_newton : 0)) * axes * number * work.sites);
  plan.drop(planCells(plan, work, Detail::polygons));
  plan.dropSince(since);
  run.planFiles(plan, work);
}

/// Returns e.g. "relax 12/50, 1.0334".
std::string progressText(std::uint64_t diagram, const RelaxStep& step, std::uint64_t iterations) {
  const std::string at = fmt::format("relax {}/{}", diagram, iterations);
  return std::isfinite(step.hexagonal) ? fmt::format("{}, {:.4f}", at, step.hexagonal)
                                       : fmt::format("{}, {:.6g}", at, step.energy);
}

RelaxOptions relaxOptions(const RelaxCommand& command, const SitesRun& run) {
  RelaxOptions options = command.options;
  options.domain = run.input->domain;
  options.outline = run.input->outline;
  options.periodic = run.input->periodic;
  options.globe = run.input->globe;
  options.density = run.density.density;
  options.search = command.search;
  options.progress = untilSignal();
  return options;
}

/// Makes the diagrams, and writes the numbered files among them.
Result<Relaxed> relaxSites(const RelaxCommand& command, SitesRun& run) {
  ProgressBar bar(command.talk.quiet);
  const std::uint64_t every = command.targets.every, iterations = command.options.iterations;
  const auto whole = static_cast<double>(std::max<std::uint64_t>(iterations, 1));
  VORPIPE_LET(film, run.openFrames());
  VORPIPE_VAR(relaxation, Relaxation::begin(*run.session, run.input->sites, relaxOptions(command, run)));
  Result<bool> more = true;
  while (more && *more) {
    const std::uint64_t diagram = relaxation.trace().back().diagram;
    bar.show(progressText(diagram, lastTaken(relaxation.trace()), iterations),
             static_cast<double>(diagram) / whole);
    if (film) {
      VORPIPE_TRY(
          run.frameOf(relaxation.sites()).and_then([&](const Image& image) { return film->add(image); }));
    }
    if (every > 0 && diagram % every == 0) {
      VORPIPE_TRY(run.writeNumbered(relaxation.sites(), diagram));
    }
    more = relaxation.step();
  }
  if (!more) return tl::unexpected(more.error());
  if (film) {
    VORPIPE_TRY(film->finish());
  }
  return Relaxed{relaxation.sites(), relaxation.trace(), relaxation.end(), relaxation.report()};
}

std::string relaxSummary(const Relaxed& relaxed) {
  const RelaxStep &first = relaxed.trace.front(), &last = lastTaken(relaxed.trace);
  std::string text = fmt::format("energy {:.6g} to {:.6g}", first.energy, last.energy);
  if (std::isfinite(last.hexagonal)) {
    text += fmt::format(" ({:.4f} to {:.4f} of the hexagonal lattice's)", first.hexagonal, last.hexagonal);
  }
  return text + fmt::format(" after {} diagrams ({})", relaxed.trace.back().diagram, nameOf(relaxed.end));
}

/// Returns the rows of --trace; without `with_times`, only what is the same in every run.
std::string traceText(const std::vector<RelaxStep>& trace, bool with_times) {
  std::string text = "diagram,energy,hexagonal,farthest,seconds,taken\n";
  const auto to = std::back_inserter(text);
  for (const RelaxStep& step : trace) {
    fmt::format_to(to, "{},{},", step.diagram, step.energy);
    if (std::isfinite(step.hexagonal)) fmt::format_to(to, "{}", step.hexagonal);
    fmt::format_to(to, ",{},", step.farthest);
    if (with_times) fmt::format_to(to, "{:.6f}", step.seconds);
    text += step.taken ? ",1\n" : ",0\n";
  }
  return text;
}

Result<void> writeFiles(const RelaxCommand& command, SitesRun& run, const Relaxed& relaxed) {
  RunOutput output{*run.input, relaxed.report};
  if (!command.targets.trace.empty())
    output.writers.push_back(traceWriter(run.log, relaxed.trace, traceText));
  output.figures = [&](nlohmann::ordered_json& json) {
    const RelaxStep &first = relaxed.trace.front(), &last = lastTaken(relaxed.trace);
    // With weights there is no reference to compare with: the dump writes null for what is not finite.
    json["relaxation"] = {{"method", nameOf(command.options.method)},
                          {"diagrams", relaxed.trace.size()},
                          {"end", nameOf(relaxed.end)},
                          {"energy", {first.energy, last.energy}},
                          {"hexagonal", {first.hexagonal, last.hexagonal}},
                          {"farthest", {first.farthest, last.farthest}}};
  };
  return run.write(relaxed.sites, std::move(output));
}

/// Rejects what is of a plane.
Result<void> checkGlobe(const RelaxCommand& command) {
  const InputOptions& input = command.input;
  if (input.domain.box || input.domain.hull || !input.domain.file.empty() || input.margin) {
    return inputError(fmt::format("{}: with --globe sites relax on the whole Earth",
                                  input.margin ? "--margin" : "--domain"));
  }
  if (command.options.equal_masses) return inputError("--equal-masses: are of a plane, and not with --globe");
  return {};
}

/// Rejects options that nothing uses, and sets the format of standard output.
Result<void> checkCommand(RelaxCommand& command, const SitesRun& run) {
  if (command.targets.frames.empty()) {
    VORPIPE_TRY(run.needsOutput("sites.csv", "--cells, --picture, --frames, --trace or --stats"));
  }
  const RenderOptions& picture = command.picture.render;
  if (!command.targets.frames.empty() && (!picture.title.empty() || picture.legend_beside)) {
    return inputError(fmt::format("{}: is for pictures, and frames of --frames have nothing around them",
                                  picture.title.empty() ? "--legend beside" : "--title"));
  }
  if (command.options.equal_masses && command.density.empty()) {
    return inputError("--equal-masses: is for a --density; without one masses are areas");
  }
  if (command.input.globe) {
    VORPIPE_TRY(checkGlobe(command));
  }
  return takeFormat(command.targets, command.input);
}

Result<ExitCode> relax(RelaxCommand& command, const Invocation& how) {
  SitesRun run("relax", command, how, command.targets.pathsWith({command.targets.trace}));
  VORPIPE_TRY(checkCommand(command, run));
  run.source.reading.attributes = command.targets.carryAttributes() || needsAttributes(command.picture);
  const PlanRun plan = std::bind_front(planRelaxation, std::cref(command), std::cref(run));
  VORPIPE_TRY(run.load(plan));
  VORPIPE_TRY(run.begin(plan));
  const auto relaxed = relaxSites(command, run);
  if (!relaxed) return asOption(relaxed.error(), run.source);
  const bool interrupted = takeSignal();
  printNotes(command.talk, relaxed->report);
  if (!validationIsSilent(relaxed->report)) return exit_device;
  VORPIPE_TRY(writeFiles(command, run, *relaxed));
  run.printSummary(
      fmt::format("{}, {}", run.outcome(relaxed->sites, relaxed->report), relaxSummary(*relaxed)),
      relaxed->report);
  if (!interrupted) return exit_done;
  printError(
      fmt::format("interrupted: the files have the sites after {} diagrams", relaxed->trace.back().diagram));
  return static_cast<ExitCode>(signalExitCode());
}

void addMethodOptions(Options& options, RelaxCommand& command) {
  options.group("Relaxation");
  const auto add = [&](const auto& row) { addRow(options, row, command.options, command.given); };
  forEachRow(method_rows, add);
  addDensityOptions(options, command.density,
                    "sites gather where it is high. --sites density:N draws N sites from it, as dense as it "
                    "is, in the box of its pixels where no --domain is named");
  add(equal_masses_row);
}

}  // namespace

void addRelax(CommandLine& line) {
  auto command = std::make_shared<RelaxCommand>();
  Options options = line.addSubcommand(
      "relax", "moves sites until each is the centroid of its cell; under a density, as in stippling",
      [command](const Invocation& how) { return relax(*command, how); });
  addInputOptions(options, command->input).required();
  addGlobe(options, command->input);
  addMethodOptions(options, *command);
  options.group("Output");
  addRelaxTargets(options, command->targets);
  addPictureGroup(options, command->picture);
  addMapOptions(options, command->picture);
  addCommonOptions(options, *command);
}

}  // namespace vorpipe::cli
