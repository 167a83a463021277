#include <fmt/format.h>

#include <memory>

#include "base/stopwatch.h"
#include "bench/measured/driver_threads.h"
#include "cli/commands/command.h"
#include "cli/options/options.h"
#include "cli/reports/stats.h"
#include "cli/runs/forecast.h"
#include "cli/runs/input.h"
#include "cli/runs/run_end.h"
#include "cli/terminal/progress.h"
#include "io/files/error.h"
#include "io/pictures/npy_ids.h"
#include "io/pictures/png_file.h"

namespace vorpipe::cli {
namespace {

struct RenderCommand {
  InputOptions input;
  BackendOptions backend;
  TalkOptions talk;
  RenderOptions picture{};
  std::optional<PictureSize> size;
  bool check = false;
  std::string png, ids, stats;
  std::optional<std::uint64_t> memory_limit;
};

/// The output files that were asked for, in the order in which they are created.
std::vector<std::string> outputPaths(const RenderCommand& command) {
  std::vector<std::string> paths;
  for (const std::string& path : {command.png, command.ids, command.stats}) {
    if (!path.empty()) paths.push_back(path);
  }
  return paths;
}

PlanRun planOf(const RenderCommand& command, const PictureSize& size) {
  return [&command, size](MemoryPlan& plan, const Workload& work) {
    planSession(plan, work);
    planPicture(plan, work, size.width, size.height, command.picture.color);
    if (command.check) planPictureCheck(plan, work, size.width, size.height);
  };
}

/// What is drawn, once the sites are known.
Result<RenderOptions> pictureOptions(const RenderCommand& command, const Input& input) {
  if (command.picture.color == ColorBy::weight && input.sites.weight.empty()) {
    return inputError(fmt::format("--color: weight needs weights; {} has none, and there is no --weights",
                                  command.input.sites));
  }
  RenderOptions options = command.picture;
  options.domain = input.domain;
  options.outline = input.outline;
  options.periodic = input.periodic;
  const PictureSize size = command.size.value_or(defaultSize(input.domain));
  options.width = size.width;
  options.height = size.height;
  return options;
}

Result<void> writeFiles(const RenderCommand& command, const Input& input, const Rendering& rendering,
                        std::uint64_t forecast, std::span<OutputFile> files, const Stopwatch& total) {
  const Stopwatch watch;
  const Image& image = rendering.image;
  std::vector<Writer> writers;
  if (!command.png.empty()) {
    writers.emplace_back([&](ByteSink& to) { return writePng(to, image.width, image.height, image.rgba); });
  }
  if (!command.ids.empty()) {
    writers.emplace_back([&](ByteSink& to) { return writeNpyIds(to, image.width, image.height, image.ids); });
  }
  if (!command.stats.empty()) {
    writers.emplace_back([&](ByteSink& to) {
      return to.write(statsJson(
          {"render", input, rendering.report, watch.milliseconds(), total.milliseconds(), forecast}));
    });
  }
  return writeOutputs(files, writers);
}

Result<ExitCode> render(const RenderCommand& command) {
  setDriverThreads(command.backend.threads);
  const Stopwatch total;
  const std::vector<std::string> paths = outputPaths(command);
  if (paths.empty() && !command.check) return tl::unexpected(nothingToDo("picture.png"));
  const auto fits = forecastGenerated(
      command.input, planOf(command, command.size.value_or(PictureSize{1, 1})), command.memory_limit);
  if (!fits) return tl::unexpected(fits.error());
  const auto input = loadInput(command.input);
  if (!input) return tl::unexpected(input.error());
  auto options = pictureOptions(command, *input);
  if (!options) return tl::unexpected(std::move(options.error()));
  const int threads = command.backend.threads;
  if (const auto checked = checkInput(command.input, *input, cellsOptions(*options), threads); !checked) {
    return tl::unexpected(checked.error());
  }
  printNotes(command.talk, *input);
  auto files = openOutputs(paths);
  if (!files) return tl::unexpected(std::move(files.error()));
  auto session = Session::open(command.backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  const auto forecast =
      forecastRun(command.input, *input, imagesFor(command.picture.color), session->device(), command.backend,
                  planOf(command, {options->width, options->height}), command.memory_limit);
  if (!forecast) return tl::unexpected(forecast.error());
  ProgressBar bar(command.talk.quiet);
  options->progress = bar.callback();
  const auto rendering = session->render(input->sites, *options);
  bar.clear();
  if (!rendering) return asOption(rendering.error(), command.input);
  printNotes(command.talk, rendering->report);
  if (!validationIsSilent(rendering->report)) return exit_device;
  if (command.check) {
    const auto passed = passesCheck(check(input->sites, *options, *rendering, threads));
    if (!passed) return tl::unexpected(passed.error());
    if (!*passed) return exit_different;
  }
  const auto written = writeFiles(command, *input, *rendering, *forecast, *files, total);
  if (!written) return tl::unexpected(written.error());
  printSummary(command.talk, paths,
               fmt::format("{}, {}x{}, {}\n", outcomeText(paths, rendering->report), options->width,
                           options->height, runText(rendering->report, total.milliseconds(), command.check)));
  if (command.talk.verbose && !session->choice().empty()) printNote(session->choice());
  return exit_done;
}

void addPictureOptions(Options& options, RenderCommand& command) {
  addFile(options, "-o", command.png, ".png", "the picture");
  addSizeOption(options, command.size);
  addFile(options, "--ids", command.ids, ".npy",
          "the site of each pixel: uint32, row 0 at the top, 4294967295 where there is none");
  addParsed(options, "--color", command.picture.color, "BY",
            fmt::format("what colors show: {} [site]", anyOf(colorNames())), parseColor, {colorNames(), {}});
  addParsed(options, "--colormap", command.picture.colormap, "NAME",
            fmt::format("the colors: {} [{}]", anyOf(colormaps()), command.picture.colormap), parseColormap,
            {colormaps(), {}});
  options.addFlag("--edges", command.picture.edges, "darkens the edges of the cells");
  options.addFlag("--show-sites", command.picture.show_sites, "draws a dot at each site");
}

}  // namespace

void addRender(CommandLine& line) {
  auto command = std::make_shared<RenderCommand>();
  Options options =
      line.addSubcommand("render", "draws the Voronoi diagram of sites; with weights, the power diagram",
                         [command] { return render(*command); });
  addInputOptions(options, command->input).required();
  addPictureOptions(options, *command);
  addBackendChoice(options, command->backend);
  addSearchOptions(options, command->picture.search);
  addRunOptions(options, command->backend, command->memory_limit);
  options.addFlag("--check", command->check,
                  "verifies statuses and the nearest site of each pixel; exit code 1 if a promise is broken");
  addAnyFile(options, "--stats", command->stats, {".json"}, "what was done, in JSON");
  addTalkOptions(options, command->talk);
}

}  // namespace vorpipe::cli
