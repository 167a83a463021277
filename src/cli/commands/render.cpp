#include <fmt/format.h>

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/option_names.h"
#include "base/try.h"
#include "cli/commands/command.h"
#include "cli/drawing.h"
#include "cli/options/error_line.h"
#include "cli/options/mass_options.h"
#include "cli/options/picture_files.h"
#include "cli/progress.h"
#include "cli/run.h"
#include "io/base/error.h"
#include "io/cells/forecast_files.h"
#include "vorpipe/shapes.h"

namespace vorpipe::cli {
namespace {

struct RenderCommand : RunOptions {
  InputOptions input;
  PictureOptions picture;
  Surface surface = Surface::none;
  PictureFiles files;
};

std::vector<std::string> pathsOf(const PictureFiles& files) {
  std::vector<std::string> paths;
  for (const PictureFile& file : files.pictures) paths.push_back(file.path);
  if (!files.ids.path.empty()) paths.push_back(files.ids.path);
  return paths;
}

DrawingNeeds needsOf(const PictureFiles& files) { return {files.needPixels(), files.needCells()}; }

/// Returns what the images of sites in a periodic domain are for.
ImagesFor imagesOf(const RenderCommand& command) {
  return command.files.needCells() ? ImagesFor::cells : imagesFor(command.picture.render);
}

/// Plans the memory of a run; `options` are those of the picture, as far as known.
void planRender(const RenderCommand& command, const RenderOptions& options, MemoryPlan& plan,
                const Workload& work) {
  planSession(plan, work);
  planColors(plan, work, command.picture);
  planDrawing(plan, work, options, needsOf(command.files), command.check);
  if (command.files.ids.format != nullptr) {
    planIdsFile(plan, work, *command.files.ids.format, {options.width, options.height});
  }
}

/// Returns what determines the colors: the scale and range of values, or the names.
nlohmann::ordered_json colorJson(const ColorKey& key) {
  const std::string by = key.color == ColorBy::value ? "@" + key.title : std::string(nameOf(key.color));
  if (!key.names.empty()) return {{"by", by}, {"names", key.names}, {"other_names", key.other_names}};
  return {{"by", by}, {"scale", nameOf(key.scale)}, {"range", {key.range.low, key.range.high}}};
}

Result<void> writeFiles(const RenderCommand& command, CommandRun& run, const Input& input,
                        const RenderOptions& options, const Drawing& drawing) {
  RunOutput output{input, drawing.report()};
  const PictureOutput picture{input.sites,
                              options,
                              drawing.pixels ? &drawing.pixels->image : nullptr,
                              drawing.cells ? &*drawing.cells : nullptr,
                              input.system,
                              command.backend.threads,
                              drawing.key};
  const auto add = [&](const auto* format) {
    output.writers.emplace_back([&picture, format](ByteSink& to) { return format->write(to, picture); });
  };
  for (const PictureFile& file : command.files.pictures) add(file.format);
  if (command.files.ids.format != nullptr) add(command.files.ids.format);
  output.figures = [&](nlohmann::ordered_json& json) {
    if (drawing.cells) json["area_sum"] = areaSum(*drawing.cells);
    if (drawing.key) json["color"] = colorJson(*drawing.key);
  };
  return run.write(output);
}

/// Rejects options that pictures of cells with a free surface do not support.
Result<void> checkSurface(const RenderCommand& command, const Sites& sites, const RenderOptions& options) {
  if (command.surface == Surface::none) return {};
  if (options.globe) return inputError("--surface: is for a plane, not for --globe");
  if (command.check) return inputError("--check: what verifies cells does not know free surfaces");
  VORPIPE_TRY(checkDiscs(sites));
  return checkFreePicture("--surface", options, needsOf(command.files));
}

/// Rejects files with the coordinates of pixels, where pixels have none.
Result<void> checkGeoreference(const RenderCommand& command) {
  if (!command.picture.render.view_from) return {};
  const auto isTied = [](std::string_view extension) {
    return extension == ".pgw" || extension.starts_with(".tif");
  };
  const auto refused = [](std::string_view option, std::string_view extension) {
    return inputError(fmt::format("{}: {} has coordinates of a map, and --view-from is no map of any system",
                                  option, extension));
  };
  for (const PictureFile& file : command.files.pictures) {
    if (isTied(file.format->extension)) return refused("-o", file.format->extension);
  }
  const IdsFormat* ids = command.files.ids.format;
  if (ids != nullptr && isTied(ids->extension)) return refused("--ids", ids->extension);
  return {};
}

Result<ExitCode> render(RenderCommand& command, const Invocation& how) {
  VORPIPE_TRY(nameStandardOutput(command.files, command.input.format.output));
  VORPIPE_TRY(checkGeoreference(command));
  CommandRun run("render", command, how, pathsOf(command.files));
  VORPIPE_TRY(run.needsOutput("picture.png", "--stats or --check"));
  RenderOptions options = command.picture.render;
  const PictureSize known = sizeBefore(command.picture);
  options.width = known.width;
  options.height = known.height;
  command.input.reading.attributes = needsAttributes(command.picture);
  const PlanRun plan = std::bind_front(planRender, std::cref(command), std::cref(options));
  VORPIPE_VAR(input, run.load(command.input, plan));
  VORPIPE_VAR(complete, pictureOf(command.picture, command.input, input));
  options = std::move(complete);
  options.search = command.search;
  VORPIPE_LET(photograph, photographOf(command.picture, command.input, input));
  const int threads = command.backend.threads;
  VORPIPE_TRY(checkInput(command.input, input, cellsOptions(options), threads));
  VORPIPE_TRY(checkSurface(command, input.sites, options));
  VORPIPE_TRY(run.begin(command.input, input, imagesOf(command), plan));
  VORPIPE_TRY(takeColors(photograph, input.sites, threads, options));
  ProgressBar bar(command.talk.quiet);
  options.progress = bar.callback();
  const auto drawing = draw(command.surface, *run.session, input.sites, options, needsOf(command.files));
  bar.clear();
  if (!drawing) return asOption(drawing.error(), command.input);
  const Report& report = drawing->report();
  printNotes(command.talk, report);
  if (command.surface == Surface::none) printMissingCells(command.talk, input, drawing->status(), report);
  if (const auto note = stretchNote(command.picture, options); !note.empty() && !command.talk.quiet) {
    printNote(note);
  }
  if (!validationIsSilent(report)) return exit_device;
  if (command.check) {
    VORPIPE_LET(passed, passesCheck(checkDrawing(input.sites, options, *drawing, threads)));
    if (!passed) return exit_different;
  }
  VORPIPE_TRY(writeFiles(command, run, input, options, *drawing));
  run.printSummary(fmt::format("{}, {}x{}", run.outcome(input.sites, report), options.width, options.height),
                   report);
  return exit_done;
}

}  // namespace

void addRender(CommandLine& line) {
  auto command = std::make_shared<RenderCommand>();
  Options options = line.addSubcommand(
      "render",
      "draws the Voronoi diagram of sites (Thiessen polygons, Dirichlet cells); with weights, "
      "the power diagram (Laguerre or radical cells)",
      [command](const Invocation& how) { return render(*command, how); });
  addInputOptions(options, command->input).required();
  command->input.keeps_whole = true;
  addParsed(
      options, "--by", command->input.by, "NAME",
      "draws the borders of the features of --domain, which this attribute names, as lines wider than edges; "
      "features of one name are one",
      parseAttributeWord);
  addGlobe(options, command->input);
  options.group("Output");
  addPictureFiles(options, command->files);
  options.group("Picture");
  addSizeOptions(options, command->picture);
  addMapOptions(options, command->picture);
  addColorOptions(options, command->picture);
  addMarkOptions(options, command->picture);
  addSurface(options, command->surface, surface_text);
  addCommonOptions(options, *command,
                   "verifies statuses and the nearest site of each pixel, of shapes the cells; exit code 1 "
                   "if a promise is broken");
}

}  // namespace vorpipe::cli
