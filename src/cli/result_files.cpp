#include "cli/result_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "base/try.h"
#include "cli/drawing.h"
#include "cli/fluid_files.h"
#include "cli/progress.h"
#include "io/base/error.h"
#include "io/cells/forecast_files.h"
#include "io/sites/sites_file.h"
#include "vorpipe/stipple.h"

namespace vorpipe::cli {
namespace {

/// Returns the number of sites in `density:N`; none if --sites is something else. Error (input): N is no
/// number of sites.
Result<std::optional<std::uint64_t>> sampledCount(std::string_view sites) {
  constexpr std::string_view prefix = "density:";
  if (!sites.starts_with(prefix)) return std::nullopt;
  const auto count = parseWhole(sites.substr(prefix.size()), 1, max_sites);
  if (!count) return inputError(fmt::format("--sites: {}: {}", sites, count.error()));
  return *count;
}

/// Replaces `density:N` by a generator of as many sites, and an unnamed domain by the box of the density's
/// pixels.
Result<void> makeGenerator(InputOptions& options, std::uint64_t count, const Density& density) {
  if (density.values.empty()) {
    return inputError(
        fmt::format("--sites: {} draws sites from a density; name it by --density", options.sites));
  }
  if (options.domain.hull) {
    return inputError(
        fmt::format("--domain: {} draws sites in a domain, and so has no hull before it", options.sites));
  }
  options.sites = fmt::format("random:{}", count);
  if (options.globe) return {};
  if (!options.domain.box && options.domain.file.empty()) {
    options.domain.box = density.box.value_or(
        Box{0, 0, static_cast<double>(density.width), static_cast<double>(density.height)});
  }
  return {};
}

/// Returns the sites in the input's coordinates: in degrees if it was projected.
PlacedSites placedBack(const Input& input, const Sites& sites) {
  PlacedSites placed;
  placed.sites = sites;
  placed.system = input.system;
  placed.projection = input.projection;
  placed.degrees = input.degrees;
  if (!input.projection) return placed;
  Sites degrees = sitesInDegrees(input, sites);
  placed.longitudes = std::move(degrees.x);
  placed.latitudes = std::move(degrees.y);
  return placed;
}

CellsOptions cellsOptions(const SitesRun& run) {
  CellsOptions options = cellsOptionsOf(*run.input, run.options.search);
  if (!options.globe) options.density = run.density.density;
  options.detail = run.command.targets.detail();
  return options;
}

/// Draws the sites of density:N in place of those of the input.
Result<void> drawSites(const SitesRun& run, std::uint64_t count, Input& input) {
  const Density& density = run.density.density;
  auto sites = input.globe ? drawnOnGlobe(density, count, run.source.seed)
                           : drawnFrom(density, input.domain, input.outline, count, run.source.seed);
  if (!sites) return asOption(std::move(sites.error()), run.source);
  input.sites.x = std::move(sites->x);
  input.sites.y = std::move(sites->y);
  return {};
}

/// Returns which kinds of pictures are needed.
DrawingNeeds needsOf(const std::vector<PictureFile>& pictures) {
  const auto of_shapes = [](const PictureFile& file) { return file.format->of_shapes; };
  return {!std::ranges::all_of(pictures, of_shapes), std::ranges::any_of(pictures, of_shapes)};
}

/// Sites, with the parts that the files need.
struct ResultParts {
  Sites plane;                     ///< in the coordinates of the domain
  PlacedSites placed{};            ///< in the coordinates of files: in degrees if the input was
  std::optional<Diagram> cells{};  ///< in the coordinates of files
  std::optional<Drawing> drawing{};
  RenderOptions render{};
};

Result<RenderOptions> renderOf(const SitesRun& run, const Sites& sites) {
  VORPIPE_VAR(render, pictureOf(run.command.picture, run.source, *run.input));
  render.search = run.options.search;
  VORPIPE_TRY(takeColors(run.photograph, sites, run.options.backend.threads, render));
  return render;
}

/// Computes what the files need.
Result<ResultParts> partsOf(SitesRun& run, const Sites& sites) {
  const ResultTargets& targets = run.command.targets;
  Session& session = *run.session;
  ResultParts parts{sites};
  if (!targets.pictures.empty()) {
    VORPIPE_VAR(render, renderOf(run, sites));
    parts.render = std::move(render);
    VORPIPE_VAR(drawing, draw(run.surface, session, sites, parts.render, needsOf(targets.pictures)));
    parts.drawing = std::move(drawing);
  }
  if (!targets.cells.empty()) {
    VORPIPE_VAR(cells, cellsWith(run.surface, session, sites, cellsOptions(run)));
    parts.cells = std::move(cells);
  }
  parts.placed = placedBack(*run.input, sites);
  Diagram none;
  backToDegrees(parts.placed, parts.cells ? *parts.cells : none, run.options.backend.threads);
  return parts;
}

/// Returns a writer for each file of ResultTargets::paths(); they refer to both arguments.
std::vector<Writer> writersOf(const SitesRun& run, const ResultParts& parts) {
  const ResultTargets& targets = run.command.targets;
  const int threads = run.options.backend.threads;
  const Sites& sites = parts.placed.sites;
  const CoordinateSystem& system = parts.placed.system;
  const std::vector<Attribute>& attributes = run.input->attributes;
  std::vector<Writer> writers;
  for (const PointsTarget& target : targets.points) {
    writers.emplace_back([&, threads, format = target.format](ByteSink& to) {
      return writePoints(to, {sites, attributes, system, threads}, *format);
    });
  }
  for (const CellsTarget& target : targets.cells) {
    writers.emplace_back([&, threads, format = target.format](ByteSink& to) {
      return writeCells(to, {sites, *parts.cells, attributes, system, false, threads}, *format);
    });
  }
  for (const PictureFile& file : targets.pictures) {
    writers.emplace_back([&, threads, format = file.format](ByteSink& to) {
      const Drawing& drawing = *parts.drawing;
      return format->write(
          to, {parts.plane, parts.render, drawing.pixels ? &drawing.pixels->image : nullptr,
               drawing.cells ? &*drawing.cells : nullptr, run.input->system, threads, drawing.key});
    });
  }
  return writers;
}

}  // namespace

Result<void> SitesRun::load(const PlanRun& plan) {
  VORPIPE_VAR(read, densityOf(command.density));
  density = std::move(read);
  VORPIPE_LET(sampled, sampledCount(source.sites));
  if (sampled) {
    VORPIPE_TRY(makeGenerator(source, *sampled, density.density));
  }
  VORPIPE_VAR(loaded, CommandRun::load(source, plan));
  VORPIPE_TRY(placeUnder(density, command.density, source, loaded));
  VORPIPE_VAR(colors, photographOf(command.picture, source, loaded));
  photograph = std::move(colors);
  if (sampled) {
    VORPIPE_TRY(drawSites(*this, *sampled, loaded));
  }
  input = std::move(loaded);
  return {};
}

Result<void> SitesRun::begin(const PlanRun& plan) {
  VORPIPE_TRY(checkInput(source, *input, cellsOptions(*this), options.backend.threads));
  if (!command.targets.pictures.empty() || !command.targets.frames.empty()) {
    VORPIPE_LET(render, pictureOf(command.picture, source, *input));
    if (surface == Surface::free) {
      VORPIPE_TRY(checkFreePicture("--picture", render, needsOf(command.targets.pictures)));
    }
  }
  awaitResultOnSignals();
  return CommandRun::begin(source, *input, ImagesFor::cells, plan);
}

void SitesRun::planDensityOf(MemoryPlan& plan, Workload& work) const {
  work.density_pixels = density.density.values.size();
  if (work.density_pixels > 0) planDensity(plan, work.density_pixels);
}

void SitesRun::planFiles(MemoryPlan& plan, const Workload& work) const {
  const ResultTargets& targets = command.targets;
  const auto domain = input ? std::optional(input->domain) : std::nullopt;
  if (!targets.pictures.empty())
    planDrawingAfterSteps(plan, work, command.picture, domain, needsOf(targets.pictures));
  if (!targets.frames.empty())
    planDrawingAfterSteps(plan, work, command.picture, domain, {.pixels = true, .cells = false});
  if (!targets.cells.empty()) planCells(plan, work, targets.detail());
  for (const CellsTarget& target : targets.cells) planCellsFile(plan, work, *target.format);
}

Result<void> SitesRun::write(const Sites& sites, RunOutput output) {
  VORPIPE_LET(parts, partsOf(*this, sites));
  std::vector<Writer> writers = writersOf(*this, parts);
  std::ranges::move(output.writers, std::back_inserter(writers));
  output.writers = std::move(writers);
  output.figures = [&, others = std::move(output.figures)](nlohmann::ordered_json& json) {
    if (parts.cells) addSums(json, *parts.cells);
    others(json);
  };
  return CommandRun::write(output);
}

Result<std::unique_ptr<view::Recorder>> SitesRun::openFrames() const {
  if (command.targets.frames.empty()) return nullptr;
  FluidTargets film;
  film.frames = command.targets.frames;
  VORPIPE_TRY(checkApart(film, files));
  auto opened = view::openRecorder(film.frames);
  if (!opened) return named("--frames", std::move(opened.error()));
  return opened;
}

Result<Image> SitesRun::frameOf(const Sites& sites) {
  VORPIPE_LET(render, renderOf(*this, sites));
  VORPIPE_VAR(drawing, draw(surface, *session, sites, render, {.pixels = true, .cells = false}));
  return std::move(drawing.pixels->image);
}

Result<void> SitesRun::writeNumbered(const Sites& sites, std::uint64_t number) {
  VORPIPE_LET(parts, partsOf(*this, sites));
  VORPIPE_VAR(numbered, createOutputs(command.targets.numberedPaths(number), files));
  const auto writers = writersOf(*this, parts);
  for (std::size_t k = 0; k < writers.size(); ++k) {
    VORPIPE_TRY(log.noteOutput(numbered[k], writers[k]));
  }
  return commitAll(numbered);
}

}  // namespace vorpipe::cli
