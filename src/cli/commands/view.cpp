#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/option_rows.h"
#include "base/try.h"
#include "bench/driver_threads.h"
#include "cli/commands/command.h"
#include "cli/drawing.h"
#include "cli/forecast.h"
#include "cli/input.h"
#include "cli/options/error_line.h"
#include "cli/options/fluid_options.h"
#include "cli/options/options.h"
#include "cli/options/picture_options.h"
#include "cli/progress.h"
#include "cli/run.h"
#include "cli/view_input.h"
#include "io/base/error.h"
#include "io/base/quoted.h"
#include "io/base/read_log.h"
#include "io/sites/density_file.h"
#include "view/app.h"
#include "view/window/window.h"

namespace vorpipe::cli {
namespace {

struct ViewCommand {
  InputOptions input;
  BackendOptions backend;
  TalkOptions talk;
  PictureOptions picture;
  PictureSize size{1280, 720};
  std::optional<view::WindowApi> window;
  std::string density, script, record, screenshot;
  std::optional<std::uint64_t> frames;
  bool relax = false, run = false;
  FluidChoices fluid;
  std::optional<view::FlowColor> flow_color;
  std::optional<std::uint64_t> memory_limit;
};

std::vector<std::string> windowNames() { return {"vulkan", "opengl"}; }

Parsed<view::WindowApi> parseWindow(std::string_view text) {
  if (text == "vulkan") return view::WindowApi::vulkan;
  if (text == "opengl") return view::WindowApi::opengl;
  return tl::unexpected(fmt::format("{} is not {}", inQuotes(text), anyOf(windowNames())));
}

/// Opens a window by the requested API; else by the backend's own, or the first that works. Sets `shown_by`
/// to its name.
Result<view::Window> openWindow(const ViewCommand& command, std::string& shown_by) {
  view::WindowOptions options;
  options.width = command.size.width;
  options.height = command.size.height;
  options.device = command.backend.device;
  options.validation = command.backend.validation;
  const bool of_opengl = command.backend.name == "opengl";
  options.api = command.window.value_or(of_opengl ? view::WindowApi::opengl : view::WindowApi::vulkan);
  shown_by = windowNames()[static_cast<std::size_t>(options.api)];
  auto window = view::Window::open(options);
  if (window || command.window || of_opengl) return window;
  options.api = view::WindowApi::opengl;
  auto other = view::Window::open(options);
  if (!other) return window;
  shown_by = "opengl";
  return other;
}

PlanRun planOf(const ViewCommand& command) {
  return [&command](MemoryPlan& plan, const Workload& work) {
    planSession(plan, work);
    RenderOptions options = command.picture.render;
    options.width = command.size.width;
    options.height = command.size.height;
    planDrawing(plan, work, options, {.pixels = true, .cells = false}, /*checks=*/false);
  };
}

/// Whether a signal has asked to stop. The window then closes in order: films are finished.
bool isInterrupted() {
  if (stopIfAsked()) return false;
  ignoreSignals();
  return true;
}

bool isFluid(const ViewCommand& command) {
  return !command.fluid.begin.empty() || !command.fluid.resume.empty();
}

/// Rejects options of a fluid if there is none, and options of sites that a fluid sets itself.
Result<void> checkFluid(const ViewCommand& command) {
  const FluidChoices& fluid = command.fluid;
  const InputOptions& input = command.input;
  const auto refused = [&](const std::string& option) {
    return inputError(fmt::format("{}: {}", option,
                                  isFluid(command) ? "is for sites that are not a fluid's"
                                                   : "is for fluids; name one with --case or --resume"));
  };
  std::vector<std::pair<std::string, bool>> of_fluids{{"--particles", fluid.particles.has_value()},
                                                      {"--flow-color", command.flow_color.has_value()},
                                                      {"--run", command.run}};
  forEachRow(fluid_rows, [&](const auto& row) {
    of_fluids.insert(of_fluids.end() - 2, {flagOf(row), fluid.given.contains(row.name)});
  });
  const std::vector<std::pair<std::string, bool>> of_sites{
      {"--sites", !input.sites.empty()},
      {"--seed", input.seed != InputOptions{}.seed},
      {"--columns", !input.reading.columns.empty()},
      {"--missing", input.reading.skip_missing},
      {"--layer", !input.reading.layer.empty()},
      {"--weights", !input.weights.empty()},
      {"--random-weights", input.random_weights.has_value()},
      {"--domain", input.domain.hull || input.domain.box},
      {"--margin", input.margin.has_value()},
      {"--project", input.project.has_value()},
      {"--periodic", input.periodic.any()},
      {"--memory-limit", command.memory_limit.has_value()},
      {"--density", !command.density.empty()},
      {"--relax", command.relax}};
  for (const auto& [option, is_given] : isFluid(command) ? of_sites : of_fluids) {
    if (is_given) return refused(option);
  }
  return {};
}

Result<view::Opened> openedBy(const ViewCommand& command) {
  if (!isFluid(command)) return openForView(command.input, command.talk);
  FluidChoices choices = command.fluid;
  choices.domain = command.input.domain.file;
  choices.domain_layer = command.input.domain_layer;
  choices.repair = command.input.repair;
  return openFluidForView(choices, command.backend, command.picture.render.search);
}

Result<view::AppOptions> appOf(const ViewCommand& command) {
  view::AppOptions options;
  if (!command.script.empty()) {
    auto script = view::readScript(command.script);
    if (!script) return named("--script", std::move(script.error()));
    options.script = std::move(*script);
  }
  if (!command.density.empty()) {
    auto density = readDensity(command.density);
    if (!density) return named("--density", std::move(density.error()));
    options.viewer.density = std::make_shared<const Density>(std::move(density->density));
    options.viewer.settings.density_path = command.density;
  }
  VORPIPE_VAR(opened, openedBy(command));
  options.viewer.opened = std::move(opened);
  options.viewer.settings.picture = command.picture.render;
  options.viewer.settings.cells = !command.picture.no_fill;
  // Where there are more, dots hide their cells.
  constexpr std::size_t most_with_dots = 2000;
  const bool is_played = !command.script.empty() || !command.record.empty() || !command.screenshot.empty();
  if (!is_played && !isFluid(command) && options.viewer.opened.sites.size() <= most_with_dots) {
    options.viewer.settings.picture.show_sites = true;
  }
  options.viewer.is_played = is_played;
  // A screenshot has no panel, so the picture must not make room for one.
  options.viewer.settings.panel = command.screenshot.empty();
  options.viewer.settings.backend = command.backend;
  if (const auto& fluid = options.viewer.opened.fluid) {
    options.viewer.settings.flow_color =
        command.flow_color.value_or(view::usualFlowColor(fluid->setup.state, command.picture.render.color));
  }
  if (const auto named = fluidCaseOf(command.fluid.begin)) {
    options.viewer.settings.parcels = command.fluid.particles.value_or(usualParcels(*named));
  }
  // A fluid gives another picture only after a step.
  const bool runs = command.relax || command.run || (isFluid(command) && command.frames);
  if (runs) options.viewer.settings.motion = view::Motion::runs;
  options.viewer.load = [input = command.input](const std::string& path) { return loadForView(path, input); };
  options.viewer.print = [](const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  options.record = command.record;
  options.screenshot = command.screenshot;
  options.frames = command.frames.value_or(1);
  options.is_stopped = isInterrupted;
  return options;
}

/// Returns the files that a window writes under fixed names, without searching for a free one.
std::vector<std::string> namedOutputs(const view::AppOptions& options) {
  std::vector<std::string> paths{options.record, options.screenshot};
  if (!options.script) return paths;
  for (const view::ScriptLine& line : options.script->lines) {
    if (const auto* const shot = std::get_if<view::Screenshot>(&line.event)) paths.push_back(shot->path);
  }
  return paths;
}

Result<ExitCode> runView(const ViewCommand& command) {
  setDriverThreads(command.backend.threads);
  const ReadLog reads(ReadLog::Notes::names);
  VORPIPE_TRY(checkFluid(command));
  if (!command.input.sites.empty()) {
    const auto fits = forecastGenerated(command.input, planOf(command), command.memory_limit);
    if (!fits) return tl::unexpected(fits.error());
  }
  VORPIPE_VAR(options, appOf(command));
  VORPIPE_TRY(checkNotRead(namedOutputs(options)));
  endOnLostDisplay(exit_device);
  VORPIPE_VAR(window, openWindow(command, options.viewer.shown_by));
  view::Screen& screen = window;
  const std::string& name = isFluid(command) ? options.viewer.opened.fluid_name : command.input.sites;
  screen.setTitle(name.empty() ? "vorpipe" : fmt::format("{} - vorpipe", name));
  options.viewer.copy = [&screen](const std::string& text) { screen.copyToClipboard(text); };
  stopOnSignals();
  const auto end = view::run(screen, std::move(options));
  if (!end) return asOption(end.error(), command.input);
  VORPIPE_TRY(stopIfAsked());
  Report report{};
  report.validation_messages = end->validation;
  if (!validationIsSilent(report)) return exit_device;
  if (command.talk.verbose) {
    printNote(fmt::format("{} pictures, {}; shown by {}", end->pictures, end->computed_by,
                          screen.presenter().name()));
  }
  return exit_done;
}

void addWindowOptions(Options& options, ViewCommand& command) {
  options.group("Window");
  addParsed(options, "--size", command.size, "WxH", "the window's size in pixels [1280x720]", parseSize);
  addParsed(options, "--window", command.window, anyOf(windowNames()),
            "what shows pictures [that of the backend, or the first that works]", parseWindow,
            {windowNames(), {}});
  addAnyFile(options, "--script", command.script, {".txt"},
             "does what stands in a file, an event to a line: move 640 360, press left, release left, scroll "
             "1, key e, resize 800 600, wait, screenshot FILE.png, close ...");
  const Option record = addFolder(options, "--record", command.record, StepsTo::folder_or_film,
                                  "what the window shows, as a film by ffmpeg, if that is on PATH, or in a "
                                  "folder of frame-00001.png and so on");
  Option screenshot = addFile(options, "--screenshot", command.screenshot, ".png",
                              "saves the picture that the window shows, and closes it");
  screenshot.excludes(record);
  addParsed(options, "--frames", command.frames, "N",
            "how many pictures are drawn before --screenshot; each is a step of --relax, or of a fluid [1]",
            [](std::string_view text) { return parseWhole(text, 1, UINT32_MAX); })
      .needs(screenshot);
  options.addFlag("--relax", command.relax, "has sites move to the centers of their cells from the start");
  addAnyFile(options, "--density", command.density, {".png", ".npy"},
             "what sites gather by when they relax: the darkness of a .png, or an array");
}

void addFluidOfView(Options& options, ViewCommand& command) {
  addFluidStart(options, command.fluid, "never");
  addFlowColor(options, command.flow_color);
  options.addFlag("--run", command.run, "has the fluid flow from the start; else Space does");
}

}  // namespace

void addView(CommandLine& line) {
  auto command = std::make_shared<ViewCommand>();
  Options options =
      line.addSubcommand("view", "opens a window to look at sites and their cells, and to change them",
                         [command](const Invocation& /*how*/) { return runView(*command); });
  addInputOptions(options, command->input);
  addFluidOfView(options, *command);
  options.group("Picture");
  addColorOptions(options, command->picture.render);
  addMarkOptions(options, command->picture, LabelsOf::indices);
  addWindowOptions(options, *command);
  addBackendChoice(options, command->backend);
  addSearchOptions(options, command->picture.render.search);
  addRunOptions(options, command->backend, command->memory_limit);
  addTalkOptions(options, command->talk, command->backend.waiting);
}

}  // namespace vorpipe::cli
