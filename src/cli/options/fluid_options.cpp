#include "cli/options/fluid_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/try.h"
#include "cli/options/row_options.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/cells/fluid_state.h"
#include "io/sites/outline_file.h"
#include "io/sites/sites_file.h"

namespace vorpipe::cli {
namespace {

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

std::vector<std::string> FluidTargets::paths() const {
  std::vector<std::string> paths;
  for (const Points& target : points) paths.push_back(target.path);
  for (const CellsTarget& target : cells) paths.push_back(target.path);
  return paths;
}

std::string_view nameOf(FluidWalls walls) { return walls == FluidWalls::slip ? "slip" : "no-slip"; }

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
  addParsed(options, "--particles", choices.particles, "N",
            fmt::format("about how many cells a named case has [{}, rayleigh-taylor {}]",
                        usualParcels(FluidCase::taylor_green), usualParcels(FluidCase::rayleigh_taylor)),
            [](std::string_view text) { return parseWhole(text, 4, max_sites); });
  forEachRow(fluid_rows, [&](const auto& row) {
    const bool ends = std::string_view(row.name) == "until";
    addRow(options, row, choices.options, choices.given, ends ? usual_end : std::string_view());
  });
}

void addFluidChoices(Options& options, FluidChoices& choices) {
  addFluidStart(options, choices, "as the case has it");
  const Option domain =
      addAnyFile(options, "--domain", choices.domain, outlineExtensions(),
                 "an outline as walls, with holes as obstacles: polygons; a named case begins inside of it");
  options.addText("--domain-layer", choices.domain_layer, "NAME", "the layer of a --domain in GeoPackage")
      .needs(domain);
  options.addFlag("--repair", choices.repair, "mends polygons of --domain that cross themselves")
      .needs(domain);
  addParsed(options, "--steps", choices.steps, "N", "ends after so many steps of this run",
            [](std::string_view text) { return parseWhole(text, 0, UINT32_MAX); });
  addParsed(options, "--seconds", choices.seconds, "S", "ends after so much time of the clock",
            [](std::string_view text) { return parseOf(std::get<0>(fluid_rows), text); });
}

void addFlowColor(Options& options, std::optional<view::FlowColor>& color) {
  addParsed(options, "--flow-color", color, "NAME",
            "colors cells by density or speed, in place of --color [density, where there are several]",
            [](std::string_view text) { return parseNameOf<view::FlowColor>(text); },
            {namesFrom<view::FlowColor>(), {}});
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
  addFolder(options, "--frames", targets.frames, StepsTo::folder_or_film,
            "an .mp4, made by ffmpeg, or an empty folder for numbered .png files: a picture every --every "
            "steps");
  addFolder(options, "--series", targets.series, StepsTo::folder,
            "a folder for ParaView: a .vtp file of the cells every --every steps, and series.pvd");
  addParsed(options, "--every", targets.every, "K", "steps between pictures and files [10]",
            [](std::string_view text) { return parseWhole(text, 1, UINT32_MAX); });
}

void takeGiven(const FluidChoices& choices, FluidOptions& options) {
  forEachRow(fluid_rows, [&](const auto& row) {
    if (choices.given.contains(row.name)) options.*row.member = choices.options.*row.member;
  });
}

namespace {

Result<FluidSetup> withoutOutline(const FluidChoices& choices, std::optional<FluidCase> named) {
  if (named) return fluidCase(*named, choices.particles.value_or(usualParcels(*named)));
  return readFluid(choices.begin.empty() ? choices.resume : choices.begin);
}

Result<FluidSetup> withOutline(const FluidChoices& choices, std::optional<FluidCase> named) {
  const auto refused = [](Error error) {
    error.message.insert(0, "--domain: ");
    return tl::unexpected(std::move(error));
  };
  auto read = readOutline(choices.domain, choices.domain_layer);
  if (!read) return refused(std::move(read.error()));
  auto outline = mended(read->outline, choices.repair);
  if (!outline) return refused(std::move(outline.error()));
  if (named) {
    auto setup =
        fluidCase(*named, choices.particles.value_or(usualParcels(*named)), std::move(outline->outline));
    if (!setup) return refused(std::move(setup.error()));
    return setup;
  }
  auto setup = readFluid(choices.begin);
  if (!setup) return setup;
  setup->options.outline = std::move(outline->outline);
  setup->options.domain = boxOf(setup->options.outline.points);
  return setup;
}

}  // namespace

Result<FluidSetup> startOf(const FluidChoices& choices) {
  if (choices.begin.empty() == choices.resume.empty()) {
    return inputError(choices.begin.empty() ? "--case: name what to begin with (or --resume a checkpoint)"
                                            : "--resume: continues a fluid, and --case begins one");
  }
  const auto named = fluidCaseOf(choices.begin);
  if (!named && choices.particles) {
    return inputError("--particles: is for named cases; files have as many as they have");
  }
  if (!choices.domain.empty() && !choices.resume.empty()) {
    return inputError("--domain: a checkpoint has its own");
  }
  auto setup = choices.domain.empty() ? withoutOutline(choices, named) : withOutline(choices, named);
  if (!setup) return setup;
  takeGiven(choices, setup->options);
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
  const std::string name = error.message.substr(0, error.message.find(':'));
  const bool given = name == "search" || (name != "until" && choices.given.contains(name));
  const std::string& file = choices.begin.empty() ? choices.resume : choices.begin;
  if (given) {
    error.message = "--" + error.message;
  } else if (error.code == ErrorCode::input && !fluidCaseOf(choices.begin) &&
             !error.message.starts_with("--")) {
    error.message = fmt::format("{}: {}", file, error.message);
  }
  return tl::unexpected(std::move(error));
}

}  // namespace vorpipe::cli
