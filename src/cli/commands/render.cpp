#include <fmt/format.h>

#include <memory>

#include "base/stopwatch.h"
#include "bench/measured/driver_threads.h"
#include "cli/commands/command.h"
#include "cli/options/options.h"
#include "cli/options/picture_options.h"
#include "cli/reports/stats.h"
#include "cli/runs/forecast.h"
#include "cli/runs/input.h"
#include "cli/runs/picture.h"
#include "cli/runs/run_end.h"
#include "cli/terminal/error_line.h"
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
  PictureOptions picture;
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
    planPicture(plan, work, size.width, size.height, command.picture.render.color);
    if (command.check) planPictureCheck(plan, work, size.width, size.height);
  };
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
      return to.write(statsJson({"render",
                                 input,
                                 rendering.report,
                                 watch.milliseconds(),
                                 total.milliseconds(),
                                 forecast,
                                 {},
                                 {},
                                 rendering.key}));
    });
  }
  return writeOutputs(files, writers);
}

Result<ExitCode> render(const RenderCommand& command) {
  setDriverThreads(command.backend.threads);
  const Stopwatch total;
  const std::vector<std::string> paths = outputPaths(command);
  if (paths.empty() && !command.check) return tl::unexpected(nothingToDo("picture.png"));
  const auto fits = forecastGenerated(command.input, planOf(command, sizeBefore(command.picture.size)),
                                      command.memory_limit);
  if (!fits) return tl::unexpected(fits.error());
  const auto input = loadInput(command.input);
  if (!input) return tl::unexpected(input.error());
  auto options = pictureOf(command.picture, command.input, *input);
  if (!options) return tl::unexpected(std::move(options.error()));
  const int threads = command.backend.threads;
  if (const auto checked = checkInput(command.input, *input, cellsOptions(*options), threads); !checked) {
    return tl::unexpected(checked.error());
  }
  auto files = openOutputs(paths);
  if (!files) return tl::unexpected(std::move(files.error()));
  auto session = Session::open(command.backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  const auto forecast =
      forecastRun(command.input, *input, imagesFor(command.picture.render.color), session->device(),
                  command.backend, planOf(command, {options->width, options->height}), command.memory_limit);
  if (!forecast) return tl::unexpected(forecast.error());
  ProgressBar bar(command.talk.quiet);
  options->progress = bar.callback();
  const auto rendering = session->render(input->sites, *options);
  bar.clear();
  if (!rendering) return asOption(rendering.error(), command.input);
  printNotes(command.talk, rendering->report);
  if (const auto note = stretchNote(command.picture, *options); !note.empty() && !command.talk.quiet) {
    printError("note: " + note);
  }
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
  addSizeOptions(options, command.picture);
  addFile(options, "--ids", command.ids, ".npy",
          "the site of each pixel: uint32, row 0 at the top, 4294967295 where there is none");
  addColorOptions(options, command.picture.render);
  addMarkOptions(options, command.picture.render);
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
  addSearchOptions(options, command->picture.render.search);
  addRunOptions(options, command->backend, command->memory_limit);
  options.addFlag("--check", command->check,
                  "verifies statuses and the nearest site of each pixel; exit code 1 if a promise is broken");
  addAnyFile(options, "--stats", command->stats, {".json"}, "what was done, in JSON");
  addTalkOptions(options, command->talk);
}

}  // namespace vorpipe::cli
