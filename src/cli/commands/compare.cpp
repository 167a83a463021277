#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/stopwatch.h"
#include "base/try.h"
#include "cli/commands/command.h"
#include "cli/comparison.h"
#include "cli/drawing.h"
#include "cli/options/error_line.h"
#include "cli/options/picture_options.h"
#include "cli/progress.h"
#include "cli/run.h"
#include "io/pictures/png_file.h"

namespace vorpipe::cli {
namespace {

struct CompareCommand : RunOptions {
  std::vector<std::string> backends;
  InputOptions input;
  PictureOptions picture;
  std::string report, png;
};

/// Adds the broken promises, prefixed with the backend's name and what broke them.
Result<void> addBroken(std::string_view name, std::string_view what,
                       const Result<std::vector<std::string>>& found, std::vector<std::string>& broken) {
  if (!found) return tl::unexpected(found.error());
  for (const std::string& promise : *found) broken.push_back(fmt::format("{}, {}: {}", name, what, promise));
  return {};
}

Result<void> checkRun(const CompareCommand& command, const Input& input, const RenderOptions& picture,
                      BackendRun& run) {
  if (!command.check) return {};
  const int threads = command.backend.threads;
  auto drawn =
      addBroken(run.name, "picture", check(input.sites, picture, run.rendering, threads), run.broken);
  if (!drawn) return drawn;
  return addBroken(run.name, "cells", check(input.sites, cellsOptions(picture), run.cells, threads),
                   run.broken);
}

Result<BackendRun> runBackend(const CompareCommand& command, const std::string& name, const Input& input,
                              RenderOptions picture) {
  BackendOptions backend = command.backend;
  backend.name = name;
  // A device name applies only to backends with devices to choose from.
  if (name == "cpu") backend.device.clear();
  VORPIPE_VAR(session, Session::open(backend));
  ProgressBar bar(command.talk.quiet);
  picture.progress = bar.callback();
  const Stopwatch render_watch;
  auto rendering = session.render(input.sites, picture);
  if (!rendering) return asOption(std::move(rendering.error()), command.input);
  const double render_ms = render_watch.milliseconds();
  const Stopwatch cells_watch;
  auto cells = session.cells(input.sites, cellsOptions(picture));
  if (!cells) return asOption(std::move(cells.error()), command.input);
  bar.clear();
  printNotes(command.talk, rendering->report, name);
  printNotes(command.talk, cells->report, name);
  BackendRun run{name, std::move(*rendering), std::move(*cells), render_ms, cells_watch.milliseconds()};
  run.choice = session.choice();
  if (command.talk.verbose && !run.choice.empty()) printNote(run.choice);
  VORPIPE_TRY(checkRun(command, input, picture, run));
  return run;
}

/// Runs every backend. Returns no runs if the validation layers reported anything, after printing their
/// messages.
Result<std::vector<BackendRun>> runBackends(const CompareCommand& command, const Input& input,
                                            const RenderOptions& options) {
  std::vector<BackendRun> runs;
  for (const std::string& name : command.backends) {
    VORPIPE_VAR(run, runBackend(command, name, input, options));
    const bool silent =
        validationIsSilent(run.rendering.report, name) && validationIsSilent(run.cells.report, name);
    if (!silent) return std::vector<BackendRun>{};
    runs.push_back(std::move(run));
  }
  return runs;
}

Result<void> writeFiles(const CompareCommand& command, CommandRun& run, const Comparison& comparison,
                        const Input& input) {
  const Report report = reportOf(comparison);
  RunOutput output{input, report};
  if (!command.report.empty()) {
    output.writers.emplace_back([&](ByteSink& to) {
      return run.log.writeTimed(
          to, [&](bool with_times) { return comparisonJson(comparison, input, with_times); });
    });
  }
  if (!command.png.empty()) {
    output.writers.emplace_back([&](ByteSink& to) {
      const Picture montage = comparisonMontage(comparison);
      return writePng(to, montage.width, montage.height, montage.rgba);
    });
  }
  output.figures = [&](nlohmann::ordered_json& json) {
    json["area_sum"] = areaSum(comparison.runs.front().cells);
  };
  return run.write(output);
}

/// Plans the memory: keeps pictures and cells of every backend, but not its session; then compares every
/// pair.
void planCompare(const CompareCommand& command, const PictureSize& size, MemoryPlan& plan, Workload work) {
  RenderOptions render = command.picture.render;
  render.width = size.width;
  render.height = size.height;
  for (const std::string& name : command.backends) {
    work.backend = name;
    planSession(plan, work);
    const auto since = plan.next();
    const std::vector kept{planPicture(plan, work, render), planCells(plan, work, Detail::measures)};
    if (command.check) planPictureCheck(plan, work, render);
    if (command.check) planCellsCheck(plan, work, Detail::measures);
    plan.dropSince(since, kept);
  }
  const auto pixels = static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
  const std::uint64_t runs = command.backends.size(), pairs = runs * (runs - 1) / 2;
  plan.take("differences of pictures", pairs * pixels);
  if (!command.png.empty()) plan.take("the pictures side by side", (runs + 2 * pairs) * pixels * 4);
}

/// Forecasts the run as if every device were software: which ones are is known only once they are open.
Result<std::uint64_t> forecastAll(const CompareCommand& command, const Input& input,
                                  const RenderOptions& options) {
  DeviceInfo software;
  software.backend = command.backends.front();
  software.type = "cpu";
  const PictureSize size{options.width, options.height};
  return forecastRun(command.input, input, ImagesFor::cells, software, command.backend,
                     std::bind_front(planCompare, std::cref(command), size), command.memory_limit);
}

Result<ExitCode> compare(const CompareCommand& command, const Invocation& how) {
  std::vector<std::string> paths{command.report, command.png};
  std::erase(paths, "");
  CommandRun run("compare", command, how, std::move(paths));
  VORPIPE_LET(input, run.load(command.input, std::bind_front(planCompare, std::cref(command),
                                                             sizeBefore(command.picture.size))));
  VORPIPE_VAR(options, pictureOf(command.picture, command.input, input));
  options.search = command.search;
  VORPIPE_TRY(checkInput(command.input, input, cellsOptions(options), command.backend.threads));
  printNotes(command.talk, input);
  VORPIPE_LET(forecast, forecastAll(command, input, options));
  run.forecast = forecast;
  VORPIPE_TRY(run.createFiles());
  VORPIPE_VAR(runs, runBackends(command, input, options));
  if (runs.empty()) return exit_device;
  std::vector<std::string> broken;
  for (const BackendRun& each : runs) broken.insert(broken.end(), each.broken.begin(), each.broken.end());
  if (!*passesCheck(broken)) return exit_different;
  const BackendRun& first = runs.front();
  printMissingCells(command.talk, input, first.cells.status, first.cells.report);
  run.log.choice = choiceOf(runs);
  VORPIPE_VAR(pairs, comparePairs(runs, input, options));
  const Comparison comparison{std::move(runs), std::move(pairs)};
  VORPIPE_TRY(writeFiles(command, run, comparison, input));
  printSummary(command.talk, run.paths, comparisonTable(comparison));
  const std::string differences = disagreementText(comparison);
  if (differences.empty()) return exit_done;
  printError(differences);
  return exit_different;
}

}  // namespace

void addCompare(CommandLine& line) {
  auto command = std::make_shared<CompareCommand>();
  Options options = line.addSubcommand(
      "compare",
      "draws and computes the same cells on several backends and compares every pair, pixels and cells",
      [command](const Invocation& how) { return compare(*command, how); });
  options.group("Device");
  addParsed(options, "--backends", command->backends, "A,B,...",
            fmt::format("what computes: two or more of {}", fmt::join(backendNames(), ", ")), parseBackends,
            {backendNames(), {}, true})
      .required();
  addInputOptions(options, command->input).required();
  options.group("Picture");
  addSizeOptions(options, command->picture);
  addDeviceChoice(options, command->backend);
  addSearchOptions(options, command->search);
  addRunOptions(options, command->backend, command->memory_limit);
  options.group("Output");
  addReport(options, "--report", command->report, "what was found, in JSON");
  addFile(options, "-o", command->png, ".png",
          "the pictures side by side, and below each pair's differences");
  addStats(options, command->stats);
  options.group("Run");
  options.addFlag(
      "--check", command->check,
      "verifies what render and cells verify, of each backend; exit code 1 if a promise is broken");
  addTalkOptions(options, command->talk, command->backend.waiting);
}

}  // namespace vorpipe::cli
