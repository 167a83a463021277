#include <fmt/format.h>

#include <memory>

#include "base/stopwatch.h"
#include "base/try.h"
#include "bench/driver_threads.h"
#include "cli/commands/command.h"
#include "cli/drawing.h"
#include "cli/forecast.h"
#include "cli/free_drawing.h"
#include "cli/input.h"
#include "cli/options/error_line.h"
#include "cli/options/mass_options.h"
#include "cli/options/options.h"
#include "cli/options/picture_files.h"
#include "cli/options/picture_options.h"
#include "cli/picture.h"
#include "cli/progress.h"
#include "cli/run_end.h"
#include "cli/stats.h"
#include "io/base/error.h"
#include "io/cells/forecast_files.h"
#include "io/pictures/picture_file.h"
#include "vorpipe/shapes.h"

namespace vorpipe::cli {
namespace {

struct RenderCommand {
  InputOptions input;
  BackendOptions backend;
  TalkOptions talk;
  PictureOptions picture;
  bool check = false;
  Surface surface = Surface::none;
  PictureFiles files;
  std::string stats;
  std::optional<std::uint64_t> memory_limit;
};

/// Returns the requested output files, in the order in which they are created.
std::vector<std::string> outputPaths(const RenderCommand& command) {
  std::vector<std::string> paths;
  for (const PictureFile& file : command.files.pictures) paths.push_back(file.path);
  for (const std::string& path : {command.files.ids.path, command.stats}) {
    if (!path.empty()) paths.push_back(path);
  }
  return paths;
}

DrawingNeeds needsOf(const PictureFiles& files) { return {files.needPixels(), files.needCells()}; }

/// Returns what the images of sites in a periodic domain are for.
ImagesFor imagesOf(const RenderCommand& command) {
  return command.files.needCells() ? ImagesFor::cells : imagesFor(command.picture.render);
}

/// Returns the memory plan of a run; `options` are those of the picture, as far as known.
PlanRun planOf(const RenderCommand& command, const RenderOptions& options) {
  return [&command, &options](MemoryPlan& plan, const Workload& work) {
    planSession(plan, work);
    planDrawing(plan, work, options, needsOf(command.files), command.check);
    if (command.files.ids.format != nullptr) {
      planIdsFile(plan, work, *command.files.ids.format, {options.width, options.height});
    }
  };
}

Result<void> writeFiles(const RenderCommand& command, const Input& input, const RenderOptions& options,
                        const Drawing& drawing, RunLog& log, std::uint64_t forecast,
                        std::span<OutputFile> files, const Stopwatch& total) {
  const Stopwatch watch;
  const PictureOutput output{input.sites,
                             options,
                             drawing.pixels ? &drawing.pixels->image : nullptr,
                             drawing.cells ? &*drawing.cells : nullptr,
                             input.system,
                             command.backend.threads};
  std::vector<Writer> writers;
  for (const PictureFile& file : command.files.pictures) {
    writers.emplace_back([&output, format = file.format](ByteSink& to) { return format->write(to, output); });
  }
  if (const IdsFile& ids = command.files.ids; !ids.path.empty()) {
    writers.emplace_back([&output, format = ids.format](ByteSink& to) { return format->write(to, output); });
  }
  const auto json = [&] {
    Stats stats{"render", input, drawing.report(), log, watch.milliseconds(), total.milliseconds(), forecast};
    if (drawing.cells) stats.area_sum = areaSum(*drawing.cells);
    stats.color = drawing.key;
    return statsJson(stats);
  };
  return writeOutputs(files, writers, log, json);
}

/// Rejects options that pictures of cells with a free surface do not support.
Result<void> checkSurface(const RenderCommand& command, const Sites& sites, const RenderOptions& options) {
  if (command.surface == Surface::none) return {};
  if (command.check) return inputError("--check: what verifies cells does not know free surfaces");
  VORPIPE_TRY(checkDiscs(sites));
  return checkFreePicture("--surface", options, needsOf(command.files));
}

Result<ExitCode> render(const RenderCommand& command, const Invocation& how) {
  setDriverThreads(command.backend.threads);
  const Stopwatch total;
  RunLog log(how, !command.stats.empty());
  log.search = command.picture.render.search;
  log.threads = command.backend.threads;
  const std::vector<std::string> paths = outputPaths(command);
  if (paths.empty() && !command.check && how.stats == nullptr)
    return tl::unexpected(nothingToDo("picture.png"));
  RenderOptions options = command.picture.render;
  const PictureSize known = sizeBefore(command.picture.size);
  options.width = known.width;
  options.height = known.height;
  const PlanRun plan = planOf(command, options);
  VORPIPE_TRY(forecastGenerated(command.input, plan, command.memory_limit));
  const auto input = loadInput(command.input);
  if (!input) return tl::unexpected(input.error());
  auto complete = pictureOf(command.picture, command.input, *input);
  if (!complete) return tl::unexpected(std::move(complete.error()));
  options = std::move(*complete);
  const int threads = command.backend.threads;
  VORPIPE_TRY(checkInput(command.input, *input, cellsOptions(options), threads));
  VORPIPE_TRY(checkSurface(command, input->sites, options));
  printNotes(command.talk, *input);
  auto files = openOutputs(paths);
  if (!files) return tl::unexpected(std::move(files.error()));
  auto session = Session::open(command.backend);
  if (!session) return tl::unexpected(std::move(session.error()));
  log.choice = session->choice();
  const auto forecast = forecastRun(command.input, *input, imagesOf(command), session->device(),
                                    command.backend, plan, command.memory_limit);
  if (!forecast) return tl::unexpected(forecast.error());
  ProgressBar bar(command.talk.quiet);
  options.progress = bar.callback();
  const bool has_air = command.surface == Surface::free;
  const auto needs = needsOf(command.files);
  const auto drawing = has_air ? drawFree(*session, input->sites, options, needs)
                               : draw(*session, input->sites, options, needs);
  bar.clear();
  if (!drawing) return asOption(drawing.error(), command.input);
  printNotes(command.talk, drawing->report());
  if (!has_air) printMissingCells(command.talk, *input, drawing->status(), drawing->report());
  if (const auto note = stretchNote(command.picture, options); !note.empty() && !command.talk.quiet) {
    printError("note: " + note);
  }
  if (!validationIsSilent(drawing->report())) return exit_device;
  if (command.check) {
    const auto passed = passesCheck(checkDrawing(input->sites, options, *drawing, threads));
    if (!passed) return tl::unexpected(passed.error());
    if (!*passed) return exit_different;
  }
  const auto written = writeFiles(command, *input, options, *drawing, log, *forecast, *files, total);
  if (!written) return tl::unexpected(written.error());
  printSummary(
      command.talk, paths,
      fmt::format("{}, {}x{}, {}\n", outcomeText(paths, input->sites, drawing->report()), options.width,
                  options.height, runText(drawing->report(), total.milliseconds(), command.check)));
  if (command.talk.verbose && !log.choice.empty()) printNote(log.choice);
  return exit_done;
}

void addPictureOptions(Options& options, RenderCommand& command) {
  options.group("Output");
  addPictureFiles(options, command.files);
  options.group("Picture");
  addSizeOptions(options, command.picture);
  addColorOptions(options, command.picture.render);
  addMarkOptions(options, command.picture);
}

}  // namespace

void addRender(CommandLine& line) {
  auto command = std::make_shared<RenderCommand>();
  Options options = line.addSubcommand(
      "render", "draws the Voronoi diagram of sites; with weights, the power diagram",
      [command](const Invocation& how) -> Result<ExitCode> {
        const auto named = nameStandardOutput(command->files, command->input.format.output);
        return named ? render(*command, how) : tl::unexpected(named.error());
      });
  addInputOptions(options, command->input).required();
  addPictureOptions(options, *command);
  addSurface(options, command->surface, surface_text);
  addBackendChoice(options, command->backend);
  addSearchOptions(options, command->picture.render.search);
  addRunOptions(options, command->backend, command->memory_limit);
  options.group("Run");
  options.addFlag("--check", command->check,
                  "verifies statuses and the nearest site of each pixel, of shapes the cells; exit code 1 if "
                  "a promise is broken");
  options.group("Output");
  addStats(options, command->stats);
  addTalkOptions(options, command->talk, command->backend.waiting);
}

}  // namespace vorpipe::cli
