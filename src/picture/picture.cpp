#include "picture/picture.h"

#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "domain/pixel_mask.h"
#include "picture/draw_marks.h"
#include "picture/draw_parts.h"
#include "picture/globe_picture.h"
#include "picture/palette.h"
#include "picture/pixels.h"
#include "sites/images.h"
#include "vorpipe.h"
#include "vorpipe/label_room.h"

namespace vorpipe {

CellsOptions cellsOptions(const RenderOptions& picture) {
  CellsOptions cells{};
  cells.domain = picture.domain;
  cells.outline = picture.outline;
  cells.periodic = picture.periodic;
  cells.search = picture.search;
  cells.detail = Detail::measures;
  cells.progress = picture.progress;
  cells.globe = picture.globe;
  return cells;
}

}  // namespace vorpipe

namespace vorpipe::core {
namespace {

/// A site has a cell if it or one of its images was drawn with one.
std::vector<Status> drawnStatuses(const SiteSet& set, const Scene& scene,
                                  const std::vector<CellStatus>& drawn) {
  std::vector<Status> status(scene.imaged.count, Status::duplicate);
  for (std::size_t i = 0; i < set.size(); ++i) {
    auto& site = status[scene.siteOf(set.id[i])];
    if (drawn[i] != CellStatus::empty) {
      site = Status::ok;
    } else if (site == Status::duplicate) {
      site = Status::empty;
    }
  }
  return status;
}

void countStatuses(const std::vector<Status>& status, Report& report) {
  for (const auto each : status) {
    ++(each == Status::ok ? report.ok : each == Status::empty ? report.empty : report.duplicate);
  }
}

/// Starts the report with the costs of the cells, to which the drawing adds its own. Work done for an earlier
/// picture costs nothing.
void beginReport(const KeptPicture& kept, Report& report) {
  const Report& cells = kept.found.diagram.report;
  report.hidden = cells.hidden;
  if (kept.before.done) {
    report.time_ms.order = 0;
    return;
  }
  report.retried = cells.retried;
  report.in_double = cells.in_double;
  report.exact = cells.exact;
  report.time_ms = cells.time_ms;
  report.pipelines = cells.pipelines;
  report.validation_messages = cells.validation_messages;
}

/// Returns the colors of cells by site; empty if there are no labels.
std::vector<std::uint32_t> colorsIn(const KeptPicture& kept, const RenderOptions& options, const Marks& marks,
                                    const Palette& palette) {
  if (marks.labels.labels.empty()) return {};
  if (hasOwnColors(options)) return options.site_colors;
  const SiteSet& set = kept.found.run->prepared.set;
  std::vector<std::uint32_t> colors(kept.found.scene.imaged.count);
  for (std::size_t i = 0; i < set.size(); ++i) {
    colors[kept.found.scene.siteOf(set.id[i])] = palette[kept.colors->index[i]];
  }
  return colors;
}

/// The palette of cells without fill.
Palette unfilledPalette(const RenderOptions& options) {
  Palette palette;
  palette.fill(unfilledColor(options));
  return palette;
}

/// Gives pixels what devices do not paint: own colors of sites, or none where cells show the background. Ids
/// are those of the scene.
void repaint(const Scene& scene, const RenderOptions& options, int threads, Image& image) {
  if (cellsShowBackground(options)) return clearColors(image);
  if (!hasOwnColors(options)) return;
  constexpr std::size_t repaint_grain = 1 << 16;
  parallelFor(image.ids.size(), repaint_grain, threadsForSteps(image.ids.size(), threads),
              [&](std::size_t begin, std::size_t end) {
                for (auto k = begin; k < end; ++k) {
                  if (image.ids[k] != no_site)
                    image.rgba[k] = options.site_colors[scene.siteOf(image.ids[k])];
                }
              });
}

/// Draws the overlays, masks everything outside the outline, and extends the picture to its full size.
/// `samples` draws cells with several samples in a pixel.
Result<void> finish(const Sites& sites, const KeptPicture& kept, const RenderOptions& options, int threads,
                    const Marks& marks, const Palette& palette, SampleDrawing* samples, Image& image) {
  const Scene& scene = kept.found.scene;
  const PictureFrame frame = shownFrame(options), shown = domainFrame(options);
  const PictureFrame in_frame{shown.left - frame.left, shown.top - frame.top, shown.width, shown.height};
  putIntoFrame(in_frame, frame.width, frame.height, image);
  if (!options.outline.empty()) {
    maskOutside(kept.rings, shownBox(options), kept.found.run->prepared.exponent, threads, image);
  }
  const Overlays overlays{options, marks, scene.sitesOr(sites), shownIn(scene, options), in_frame, threads};
  repaint(scene, options, threads, image);
  const auto draw = [&](int first, int last) {
    auto rows = samples->draw(first, last);
    if (rows) repaint(scene, options, threads, *rows);
    return rows;
  };
  VORPIPE_TRY(drawOverlays(overlays, draw, image));
  nameSites(scene, image.ids);
  completePicture(options, marks, colorsIn(kept, options, marks, palette), kept.colors->key, threads, image);
  return {};
}

}  // namespace

Result<Rendering> renderKept(const Machine& machine, const Sites& sites, const RenderOptions& options,
                             const Marks& marks, KeptPicture& kept) {
  Rendering rendering;
  Report& report = rendering.report;
  beginReport(kept, report);
  const Stopwatch order_watch;
  VORPIPE_TRY(colorPicture(sites, options, machine.threads, kept));
  rendering.key = kept.colors->key;
  VORPIPE_LET(colors, paletteOf(options, rendering.key));
  const Palette palette = options.fill ? colors : unfilledPalette(options);
  auto& cells = kept.found.diagram;
  auto& run = kept.found.run;
  const Scene& scene = kept.found.scene;
  const SiteSet& set = run->prepared.set;
  const auto& palette_indices = kept.colors->index;
  const ShownPart shown = shownPart(scene, options, run->prepared.exponent);
  WhatToDraw what = whatToDraw(set, options, shown);
  report.time_ms.order += 1e3 * order_watch.seconds();

  CellDrawing drawing(
      {machine.backend, run->exact_search, set, options.search, machine.threads, options.progress},
      palette_indices, std::move(what), kept.before);
  const NearestSites nearest{run->exact_search, set, palette_indices, scene.sitesOr(sites).size(),
                             machine.threads};
  const auto room = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  VORPIPE_VAR(picture, drawParts(machine.backend, drawing, nearest, shown, palette, room));
  rendering.image = std::move(picture.image);
  report.time_ms.download = 1e3 * picture.download_seconds;
  report.pixels = picture.uncovered;
  drawing.describe(report);
  std::optional<SampleDrawing> samples;
  if (options.antialias > 1) samples.emplace(machine, nearest, options, palette, kept);
  const Stopwatch finish_watch;
  VORPIPE_TRY(finish(sites, kept, options, machine.threads, marks, palette, samples ? &*samples : nullptr,
                     rendering.image));
  if (samples) report.time_ms.draw += 1e3 * finish_watch.seconds();
  rendering.status = kept.hasCells() ? cells.status : drawnStatuses(set, scene, kept.before.status);
  countStatuses(rendering.status, report);
  rendering.owner = kept.hasCells() ? cells.owner : run->prepared.owner;
  rendering.owner.resize(scene.imaged.count);
  kept.before.done = true;
  nameDevice(machine.backend, report);
  return rendering;
}

Result<void> checkRender(const RenderOptions& options) {
  VORPIPE_TRY(checkPicture(options));
  VORPIPE_TRY(checkLetters(options, "a picture of pixels", pixelsHaveLetters));
  VORPIPE_TRY(paletteOf(options, std::nullopt));
  return {};
}

Result<Rendering> renderOn(const Machine& machine, const Sites& sites, const RenderOptions& options) {
  VORPIPE_TRY(checkRender(options));
  if (options.globe) return renderGlobe(machine, sites, options);
  VORPIPE_LET(with_cells, needsCells(sites, options, machine.threads));
  // Done before the drawn cells, since only one run at a time has the exact tier. If the picture is not drawn
  // from cells as data, these cells change no pixel's site.
  std::optional<Diagram> apart;
  if (marksNeedCells(options) && !with_cells) {
    CellsOptions wanted = cellsOptions(options);
    wanted.detail = marksDetail(options);
    VORPIPE_VAR(found, cellsOn(machine, sites, wanted));
    apart = std::move(found);
  }
  VORPIPE_VAR(kept, findPicture(machine, sites, options, with_cells));
  const Diagram& marked = apart ? *apart : kept.found.diagram;
  VORPIPE_LET(marks, marksOf(sites, marked, options, machine.threads));
  std::string note = noteOnRoom(marked, options, marks.labels);
  apart.reset();
  auto rendering = renderKept(machine, sites, options, marks, kept);
  if (rendering && !note.empty()) rendering->report.notes.push_back(std::move(note));
  return rendering;
}

}  // namespace vorpipe::core
