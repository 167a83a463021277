#include "cli/options/fluid_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/try.h"
#include "cli/options/options.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/cells/fluid_state.h"
#include "io/sites/sites_file.h"

namespace vorpipe::cli {
namespace {

std::vector<std::string> flowColorNames() { return {"none", "density", "speed"}; }

Parsed<view::FlowColor> parseFlowColor(std::string_view text) {
  if (text == "none") return view::FlowColor::none;
  if (text == "density") return view::FlowColor::density;
  if (text == "speed") return view::FlowColor::speed;
  return tl::unexpected(fmt::format("{} is not {}", inQuotes(text), anyOf(flowColorNames())));
}

std::vector<std::string> schemeNames() { return {"springs", "projection"}; }

Parsed<FluidScheme> parseScheme(std::string_view text) {
  if (text == "springs") return FluidScheme::springs;
  if (text == "projection") return FluidScheme::projection;
  return tl::unexpected(fmt::format("{} is not {}", inQuotes(text), anyOf(schemeNames())));
}

Parsed<double> parsePositive(std::string_view text) {
  VORPIPE_LET(number, parseNumber(text));
  if (number > 0) return number;
  return tl::unexpected(fmt::format("{} is not more than 0", number));
}

/// 0 for `auto`.
Parsed<double> parseStep(std::string_view text) {
  if (text == "auto") return 0;
  return parsePositive(text);
}

Parsed<Point> parseGravity(std::string_view text) {
  const std::size_t comma = text.find(',');
  const auto refused = [&] { return tl::unexpected(fmt::format("{} is not GX,GY", inQuotes(text))); };
  if (comma == std::string_view::npos) return refused();
  const auto x = parseNumber(text.substr(0, comma)), y = parseNumber(text.substr(comma + 1));
  if (!x || !y) return refused();
  return Point{*x, *y};
}

/// A name of fluidCaseNames(), or an .npz file.
Parsed<std::string> parseCase(std::string_view text) {
  if (fluidCaseOf(text)) return std::string(text);
  const std::string path(text);
  if (lowerExtension(path) == ".npz") return path;
  return tl::unexpected(
      fmt::format("{} is not {}, or an .npz file", inQuotes(text), anyOf(fluidCaseNames())));
}

void addOutcomeFiles(Options& options, FluidTargets& targets) {
  const auto points = pointsExtensions(), cells = cellsExtensions();
  addRepeatable(
      options, "-o", "FILE",
      fmt::format("the sites at the end with their weights, by the extension: {}; repeatable",
                  fmt::join(points, ", ")),
      [](std::string_view text) { return parseNamed<FluidTargets::Points>(text, pointsFormatOf); },
      [&targets](FluidTargets::Points target) { targets.points.push_back(std::move(target)); },
      {{}, {points.begin(), points.end()}});
  addRepeatable(
      options, "--cells", "FILE",
      fmt::format("their cells, as `vorpipe cells` writes them: {}; repeatable", fmt::join(cells, ", ")),
      [](std::string_view text) { return parseNamed<CellsTarget>(text, cellsFormatOf); },
      [&targets](CellsTarget target) { targets.cells.push_back(std::move(target)); },
      {{}, {cells.begin(), cells.end()}});
}

}  // namespace

std::string_view nameOf(FluidScheme scheme) {
  return scheme == FluidScheme::springs ? "springs" : "projection";
}

std::vector<std::string> FluidTargets::paths() const {
  std::vector<std::string> paths;
  for (const Points& target : points) paths.push_back(target.path);
  for (const CellsTarget& target : cells) paths.push_back(target.path);
  return paths;
}

void addFluidStart(Options& options, FluidChoices& choices, std::string_view usual_end) {
  options.group("Fluid");
  addParsed(
      options, "--case", choices.begin, "NAME|FILE",
      fmt::format("what the fluid begins as: {}; or an .npz file with arrays `sites` and `velocity` (N, 2), "
                  "`domain` (4) and perhaps others of a checkpoint",
                  fmt::join(fluidCaseNames(), ", ")),
      parseCase, {fluidCaseNames(), {".npz"}});
  addFile(
      options, "--resume", choices.resume, ".npz",
      "a --checkpoint to go on from, with the options that it was made with; the bytes are those of a run "
      "that was not interrupted");
  addParsed(options, "--particles", choices.particles, "N", "about how many cells a named case has [2048]",
            [&choices](std::string_view text) {
              choices.particles_named = true;
              return parseWhole(text, 4, max_sites);
            });
  addParsed(options, "--time", choices.until, "T", fmt::format("the time at which it ends [{}]", usual_end),
            parsePositive);
  addParsed(options, "--step", choices.step, "S",
            "time of a step; auto: as long as speeds and springs allow [auto]", parseStep);
  addParsed(
      options, "--scheme", choices.scheme, "NAME",
      "springs, which pull sites to the centroids of their cells, and have free surfaces; or projection, "
      "with reflection: more exact for smooth flows, in domains that are full [springs]",
      parseScheme, {schemeNames(), {}});
  addParsed(
      options, "--epsilon", choices.epsilon, "E",
      "softness of springs, a time: they swing in 2 pi of it [2 spacings of cells over the largest first "
      "speed, or over half of that of a fall from the top; 3 spacings with a free surface]",
      parsePositive);
  addParsed(options, "--gravity", choices.gravity, "GX,GY", "acceleration [as the case has it]",
            parseGravity);
  addParsed(options, "--tolerance", choices.tolerance, "T",
            "no area differs from its own by more than this part of it [1e-6]", parsePositive);
}

void addFluidChoices(Options& options, FluidChoices& choices) {
  addFluidStart(options, choices, "as the case has it");
  addParsed(options, "--steps", choices.steps, "N", "ends after so many steps of this run",
            [](std::string_view text) { return parseWhole(text, 0, UINT32_MAX); });
  addParsed(options, "--seconds", choices.seconds, "S", "ends after so much time of the clock",
            parsePositive);
}

void addFlowColor(Options& options, std::optional<view::FlowColor>& color) {
  addParsed(options, "--flow-color", color, "NAME",
            "colors cells by density or speed, in place of --color [density, where there are several]",
            parseFlowColor, {flowColorNames(), {}});
}

void addFluidTargets(Options& options, FluidTargets& targets) {
  addOutcomeFiles(options, targets);
  addFile(options, "--checkpoint", targets.checkpoint, ".npz",
          "all that later steps depend on, for --resume; written every --every steps and at the end, each "
          "time whole");
  addFile(
      options, "--trace", targets.trace, ".csv",
      "a row for each step, as soon as it is made: its time and length, energies, momentum, the worst area, "
      "the longest way of a site to its centroid in spacings, diagrams, and the seconds since the first; "
      "--resume goes on with it");
  addAnyFile(options, "--frames", targets.frames, {".mp4"},
             "an .mp4, made by ffmpeg, or an empty folder for numbered .png files: a picture every --every "
             "steps");
  addAnyFile(options, "--series", targets.series, {},
             "a folder for ParaView: a .vtp file of the cells every --every steps, and series.pvd");
  addParsed(options, "--every", targets.every, "K", "steps between pictures and files [10]",
            [](std::string_view text) { return parseWhole(text, 1, UINT32_MAX); });
}

Result<FluidSetup> startOf(const FluidChoices& choices) {
  if (choices.begin.empty() == choices.resume.empty()) {
    return inputError(choices.begin.empty() ? "--case: name what to begin with (or --resume a checkpoint)"
                                            : "--resume: continues a fluid, and --case begins one");
  }
  const auto named = fluidCaseOf(choices.begin);
  if (!named && choices.particles_named) {
    return inputError("--particles: is for named cases; files have as many as they have");
  }
  auto setup = named ? Result<FluidSetup>(fluidCase(*named, choices.particles))
                     : readFluid(choices.begin.empty() ? choices.resume : choices.begin);
  if (!setup) return setup;
  FluidOptions& options = setup->options;
  if (choices.until) options.until = *choices.until;
  if (choices.step) options.step = *choices.step;
  if (choices.epsilon) options.epsilon = *choices.epsilon;
  if (choices.tolerance) options.tolerance = *choices.tolerance;
  if (choices.gravity) options.gravity = *choices.gravity;
  if (choices.scheme) options.scheme = *choices.scheme;
  return setup;
}

Result<FluidSetup> setupOf(const FluidChoices& choices) {
  auto setup = startOf(choices);
  if (setup && !std::isfinite(setup->options.until) && !choices.steps && !choices.seconds) {
    return inputError("--time: name when to end (or --steps or --seconds)");
  }
  return setup;
}

tl::unexpected<Error> asFluidOption(Error error, const FluidChoices& choices) {
  const std::pair<std::string_view, bool> options[] = {
      {"step:", choices.step.has_value()},           {"epsilon:", choices.epsilon.has_value()},
      {"gravity:", choices.gravity.has_value()},     {"scheme:", choices.scheme.has_value()},
      {"tolerance:", choices.tolerance.has_value()}, {"search:", true}};
  const auto given = std::ranges::find_if(
      options, [&](const auto& option) { return option.second && error.message.starts_with(option.first); });
  const std::string& file = choices.begin.empty() ? choices.resume : choices.begin;
  if (given != std::end(options)) {
    error.message = "--" + error.message;
  } else if (error.code == ErrorCode::input && !fluidCaseOf(choices.begin) &&
             !error.message.starts_with("--")) {
    error.message = fmt::format("{}: {}", file, error.message);
  }
  return tl::unexpected(std::move(error));
}

}  // namespace vorpipe::cli
