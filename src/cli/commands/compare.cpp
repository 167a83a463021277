#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
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
#include "io/base/error.h"
#include "io/pictures/png_file.h"

namespace vorpipe::cli {
namespace {

struct CompareCommand : RunOptions {
  std::vector<BackendDevice> backends;
  InputOptions input;
  PictureOptions picture;
  std::string reference;  ///< a file; empty: none
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

Result<BackendRun> runBackend(const CompareCommand& command, const BackendDevice& named, const Input& input,
                              RenderOptions picture) {
  const std::string& name = named.text;
  BackendOptions backend = command.backend;
  backend.name = named.backend;
  // --device is for backends that have devices to choose from, unless one follows the name.
  if (backend.name == "cpu" || !named.device.empty()) backend.device = named.device;
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
  for (const BackendDevice& named : command.backends) {
    VORPIPE_VAR(run, runBackend(command, named, input, options));
    const bool silent = validationIsSilent(run.rendering.report, named.text) &&
                        validationIsSilent(run.cells.report, named.text);
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
  for (const BackendDevice& named : command.backends) {
    work.backend = named.backend;
    planSession(plan, work);
    const auto since = plan.next();
    const std::vector kept{planPicture(plan, work, render), planCells(plan, work, Detail::measures)};
    if (command.check) planPictureCheck(plan, work, render);
    if (command.check) planCellsCheck(plan, work, Detail::measures);
    plan.dropSince(since, kept);
  }
  const auto pixels = static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
  const std::uint64_t runs = command.backends.size(), kept = command.reference.empty() ? 0 : 1;
  const std::uint64_t pairs = runs * (runs - 1) / 2 + kept * runs;
  // The ids of a reference in colors are found for one pair at a time.
  plan.take("the reference", 2 * kept * pixels * sizeof(std::uint32_t));
  plan.take("differences of pictures", pairs * pixels);
  if (command.png.empty()) return;
  // Panels beside the montage of them.
  const std::uint64_t panels = runs + kept + pairs, places = 2 * std::max(runs + kept, pairs);
  const auto heading =
      static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(headingHeight(size.width));
  plan.take("the pictures side by side", (panels + places) * (pixels + heading) * sizeof(std::uint32_t));
}

/// Forecasts the run as if every device were software: which ones are is known only once they are open.
Result<std::uint64_t> forecastAll(const CompareCommand& command, const Input& input,
                                  const RenderOptions& options) {
  DeviceInfo software;
  software.backend = command.backends.front().backend;
  software.type = "cpu";
  const PictureSize size{options.width, options.height};
  return forecastRun(command.input, input, ImagesFor::cells, software, command.backend,
                     std::bind_front(planCompare, std::cref(command), size), command.memory_limit);
}

/// Returns what to draw: where there is a reference and no --size, pictures of its size. Errors (input):
/// those of pictureOf; --size is another.
Result<RenderOptions> pictureBeside(const std::optional<Reference>& reference, const CompareCommand& command,
                                    const Input& input) {
  PictureOptions picture = command.picture;
  VORPIPE_VAR(usual, pictureOf(picture, command.input, input));
  if (!reference) return usual;
  const auto [width, height] = std::pair(reference->image.width, reference->image.height);
  const auto fits = [&](const RenderOptions& options) {
    return options.width == width && options.height == height;
  };
  if (fits(usual)) return usual;
  if (picture.size.sides || picture.size.paper || picture.size.longer_side > 0) {
    return inputError(fmt::format("--reference: {} is {}x{}, with this --size pictures are {}x{}",
                                  reference->path, width, height, usual.width, usual.height));
  }
  // The reference may come from `--size N`, whose picture has the domain's aspect, where `--size WxH` may add
  // bars.
  picture.size.longer_side = std::max(width, height);
  VORPIPE_VAR(longer, pictureOf(picture, command.input, input));
  if (fits(longer)) return longer;
  picture.size.sides = PictureSize{width, height};
  return pictureOf(picture, command.input, input);
}

Result<std::optional<Reference>> loadReference(const CompareCommand& command, const Input& input) {
  if (command.reference.empty()) return std::nullopt;
  VORPIPE_VAR(reference, readReference(command.reference));
  VORPIPE_TRY(checkIds(reference.path, reference.image, input.sites));
  return reference;
}

Result<ExitCode> compare(const CompareCommand& command, const Invocation& how) {
  if (command.backends.size() < 2 && command.reference.empty()) {
    return inputError("--backends: needs at least two backends, as in cpu,vulkan-geometry, or a --reference");
  }
  std::vector<std::string> paths{command.report, command.png};
  std::erase(paths, "");
  CommandRun run("compare", command, how, std::move(paths));
  VORPIPE_LET(input, run.load(command.input,
                              std::bind_front(planCompare, std::cref(command), sizeBefore(command.picture))));
  VORPIPE_VAR(reference, loadReference(command, input));
  VORPIPE_VAR(options, pictureBeside(reference, command, input));
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
  Comparison comparison{std::move(runs), std::move(reference)};
  VORPIPE_TRY(comparePairs(comparison, input, options));
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
  addParsed(
      options, "--backends", command->backends, "A,B,...",
      fmt::format("what computes: two or more of {}, or one and a --reference; a device follows a colon, its "
                  "index or a part of its name: vulkan-compute:0,vulkan-compute:1",
                  fmt::join(backendNames(), ", ")),
      parseBackendDevices, {backendNames(), {}, true})
      .required();
  addInputOptions(options, command->input).required();
  addGlobe(options, command->input);
  options.group("Picture");
  addSizeOptions(options, command->picture);
  addMapOptions(options, command->picture);
  addAnyFile(
      options, "--reference", command->reference, {".npy", ".png"},
      "what an earlier run wrote, one more to compare with: --ids of render (.npy), or its picture (.png) "
      "without options of colors and marks; without --size pictures have its size");
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
