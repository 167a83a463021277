#include "cli/result_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/try.h"
#include "cli/free_drawing.h"
#include "cli/picture.h"
#include "io/cells/forecast_files.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::cli {
namespace {

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

CellsOptions cellsOptions(const ResultJob& job) {
  CellsOptions options{};
  options.domain = job.input.domain;
  options.outline = job.input.outline;
  options.periodic = job.input.periodic;
  options.density = job.density;
  options.search = job.search;
  options.detail = job.targets.detail();
  return options;
}

}  // namespace

void planFiles(MemoryPlan& plan, const Workload& work, const ResultTargets& targets,
               const PictureOptions& picture, const std::optional<Box>& domain) {
  const PictureSize size = sizeOf(picture, domain);
  RenderOptions render = picture.render;
  render.width = size.width;
  render.height = size.height;
  if (!targets.pictures.empty()) planDrawingAfterSteps(plan, work, render, needsOf(targets.pictures));
  if (!targets.cells.empty()) planCells(plan, work, targets.detail());
  for (const CellsTarget& target : targets.cells) planCellsFile(plan, work, *target.format);
}

Result<void> checkBefore(const ResultJob& job) {
  VORPIPE_TRY(checkInput(job.options, job.input, cellsOptions(job), job.threads));
  if (job.targets.pictures.empty()) return {};
  const auto render = pictureOf(job.picture, job.options, job.input);
  if (!render) return tl::unexpected(render.error());
  return job.surface == Surface::free ? checkFreePicture("--picture", *render, needsOf(job.targets.pictures))
                                      : Result<void>();
}

DrawingNeeds needsOf(const std::vector<PictureFile>& pictures) {
  const auto of_shapes = [](const PictureFile& file) { return file.format->of_shapes; };
  return {!std::ranges::all_of(pictures, of_shapes), std::ranges::any_of(pictures, of_shapes)};
}

Result<ResultParts> partsOf(Session& session, const ResultJob& job, const Sites& sites) {
  const bool has_air = job.surface == Surface::free;
  ResultParts parts{sites};
  if (!job.targets.pictures.empty()) {
    auto render = pictureOf(job.picture, job.options, job.input);
    if (!render) return tl::unexpected(std::move(render.error()));
    parts.render = std::move(*render);
    parts.render.search = job.search;
    const auto needs = needsOf(job.targets.pictures);
    auto drawing =
        has_air ? drawFree(session, sites, parts.render, needs) : draw(session, sites, parts.render, needs);
    if (!drawing) return tl::unexpected(std::move(drawing.error()));
    parts.drawing = std::move(*drawing);
  }
  Diagram none;
  if (!job.targets.cells.empty()) {
    auto cells =
        has_air ? freeCells(session, sites, cellsOptions(job)) : session.cells(sites, cellsOptions(job));
    if (!cells) return tl::unexpected(std::move(cells.error()));
    parts.cells = std::move(*cells);
  }
  parts.placed = placedBack(job.input, sites);
  backToDegrees(parts.placed, parts.cells ? *parts.cells : none, job.threads);
  return parts;
}

std::vector<Writer> writersOf(const ResultJob& job, const ResultParts& parts) {
  std::vector<Writer> writers;
  for (const PointsTarget& target : job.targets.points) {
    writers.emplace_back([&, format = target.format](ByteSink& to) {
      return writePoints(to, {parts.placed.sites, job.input.attributes, parts.placed.system, job.threads},
                         *format);
    });
  }
  for (const CellsTarget& target : job.targets.cells) {
    writers.emplace_back([&, format = target.format](ByteSink& to) {
      return writeCells(
          to,
          {parts.placed.sites, *parts.cells, job.input.attributes, parts.placed.system, false, job.threads},
          *format);
    });
  }
  for (const PictureFile& file : job.targets.pictures) {
    writers.emplace_back([&, format = file.format](ByteSink& to) {
      const Drawing& drawing = *parts.drawing;
      return format->write(to, {parts.plane, parts.render, drawing.pixels ? &drawing.pixels->image : nullptr,
                                drawing.cells ? &*drawing.cells : nullptr, job.input.system, job.threads});
    });
  }
  return writers;
}

std::string traceText(const std::vector<RelaxStep>& trace, bool with_times) {
  std::string text = "diagram,energy,hexagonal,farthest,seconds,taken\n";
  const auto to = std::back_inserter(text);
  for (const RelaxStep& step : trace) {
    fmt::format_to(to, "{},{},", step.diagram, step.energy);
    if (std::isfinite(step.hexagonal)) fmt::format_to(to, "{}", step.hexagonal);
    fmt::format_to(to, ",{},", step.farthest);
    if (with_times) fmt::format_to(to, "{:.6f}", step.seconds);
    text += step.taken ? ",1\n" : ",0\n";
  }
  return text;
}

}  // namespace vorpipe::cli
