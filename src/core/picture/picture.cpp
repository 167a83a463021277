#include "core/picture/picture.h"

#include <algorithm>
#include <utility>

#include "base/stopwatch.h"
#include "core/drawing/near_view.h"
#include "core/outline/pixel_mask.h"
#include "core/periodic/scene.h"
#include "core/picture/colormap.h"
#include "core/picture/draw_legend.h"
#include "core/picture/frame.h"
#include "core/picture/overlay.h"
#include "core/picture/shown_part.h"
#include "core/picture/uncovered.h"
#include "vorpipe.h"

namespace vorpipe::core {
namespace {

/// A picture that is drawn in parts has several views: the place of one in the image, rows from the bottom.
struct Part {
  int column, row, width, height;
};

std::vector<Part> partsOf(int width, int height, int most) {
  std::vector<Part> parts;
  for (int row = 0; row < height; row += most) {
    for (int column = 0; column < width; column += most) {
      parts.push_back({column, row, std::min(most, width - column), std::min(most, height - row)});
    }
  }
  return parts;
}

/// Copies a part, whose row 0 is the bottom, into the image, whose row 0 is the top.
void place(const Part& part, const std::vector<std::uint32_t>& from, const Image& image,
           std::vector<std::uint32_t>& to) {
  const auto width = static_cast<std::size_t>(part.width);
  for (int row = 0; row < part.height; ++row) {
    const auto target =
        static_cast<std::size_t>(image.height - 1 - part.row - row) * static_cast<std::size_t>(image.width) +
        static_cast<std::size_t>(part.column);
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(row) * width), width,
                to.begin() + static_cast<std::ptrdiff_t>(target));
  }
}

/// What was drawn of a picture, and how.
struct Drawn {
  Image image;
  double download_seconds = 0;
  std::uint64_t uncovered = 0;  ///< pixels that the device left
};

View viewOf(const ShownPart& shown, const Part& part, const Palette& palette) {
  return {shown.boxOf(part.column, part.row, part.width, part.height),
          part.width,
          part.height,
          palette,
          {shown.box.xmin, shown.box.ymin}};
}

/// `room` is how many pixels the picture will have.
Result<Drawn> drawParts(Backend& backend, CellDrawing& drawing, const NearestSites& nearest,
                        const ShownPart& shown, const Palette& palette, std::size_t room) {
  Drawn drawn{{shown.width, shown.height, {}, {}}};
  Image& image = drawn.image;
  const auto pixels = static_cast<std::size_t>(shown.width) * static_cast<std::size_t>(shown.height);
  image.rgba.reserve(room);
  image.ids.reserve(room);
  image.rgba.resize(pixels);
  image.ids.resize(pixels);
  std::vector<std::uint32_t> rgba;
  std::vector<std::uint32_t> ids;
  for (const auto& part : partsOf(shown.width, shown.height, backend.info().max_view)) {
    const View view = viewOf(shown, part, palette);
    if (auto done = drawing.draw(view); !done) return tl::unexpected(done.error());
    rgba.resize(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
    ids.resize(rgba.size());
    Stopwatch watch;
    if (auto read = drawing.read(view, rgba, ids); !read) return tl::unexpected(read.error());
    drawn.uncovered += coverRest(nearest, view, rgba, ids);
    place(part, rgba, image, image.rgba);
    place(part, ids, image, image.ids);
    drawn.download_seconds += watch.seconds();
  }
  if (pixels == 0) {
    if (auto found = drawing.findStatuses(); !found) return tl::unexpected(found.error());
  }
  return drawn;
}

/// Which cells are drawn, and by whom. To choose them pays where the others are as many at least.
WhatToDraw whatToDraw(const SiteSet& set, const RenderOptions& options, const ShownPart& shown) {
  WhatToDraw what;
  if (!options.view) return what;
  if (shown.width == 0) {
    what.shown.emplace();
    return what;
  }
  const View view = viewOf(shown, {0, 0, shown.width, shown.height}, {});
  what.by_device = isForDevices(view);
  const Box& box = view.box;
  const Box in_set{view.corner.x + box.xmin, view.corner.y + box.ymin, view.corner.x + box.xmax,
                   view.corner.y + box.ymax};
  const Box& domain = set.domain;
  const double part = (box.xmax - box.xmin) / (domain.xmax - domain.xmin) *
                      ((box.ymax - box.ymin) / (domain.ymax - domain.ymin));
  if (2 * part < 1 || !what.by_device) what.shown = sitesNear(set, in_set);
  return what;
}

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

/// Takes over what the cells took, to which the drawing adds; what was done for a picture before took
/// nothing.
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
  report.validation_messages = cells.validation_messages;
}

/// Darkens edges in a part of an image alone: where the domain ends, cells do, but no other begins.
void drawEdgesIn(const PictureFrame& part, double width, int threads, Image& image) {
  if (part.width == image.width && part.height == image.height) return drawEdges(image, width, threads);
  if (part.width == 0) return;
  Image cut = partOf(image, part);
  drawEdges(cut, width, threads);
  putPart(cut, part, image);
}

/// Draws what lies over cells, masks what lies outside of the outline, and makes the picture as large as it
/// is to be.
void finish(const Sites& sites, const KeptPicture& kept, const RenderOptions& options, int threads,
            Image& image) {
  const Scene& scene = kept.found.scene;
  const PictureFrame frame = shownFrame(options), shown = domainFrame(options);
  const PictureFrame in_frame{shown.left - frame.left, shown.top - frame.top, shown.width, shown.height};
  putIntoFrame(in_frame, frame.width, frame.height, image);
  if (!options.outline.empty()) {
    maskOutside(kept.rings, shownBox(options), kept.found.run->prepared.exponent, threads, image);
  }
  if (options.edges) drawEdgesIn(in_frame, options.edge_width, threads, image);
  if (options.show_sites) {
    drawSites(image, scene.sitesOr(sites), shownIn(scene, options), options.dot_size);
  }
  nameSites(scene, image.ids);
  putIntoFrame(frame, options.width, options.height, image);
  if (options.legend) {
    drawLegend(legendOf(*kept.colors->key, options.colormap, options.width, options.height), image);
  }
}

}  // namespace

}  // namespace vorpipe::core

namespace vorpipe {

CellsOptions cellsOptions(const RenderOptions& picture) {
  CellsOptions cells{};
  cells.domain = picture.domain;
  cells.outline = picture.outline;
  cells.periodic = picture.periodic;
  cells.search = picture.search;
  cells.detail = Detail::measures;
  cells.progress = picture.progress;
  return cells;
}

}  // namespace vorpipe

namespace vorpipe::core {

Result<Rendering> renderKept(const Machine& machine, const Sites& sites, const RenderOptions& options,
                             KeptPicture& kept) {
  const auto palette = paletteByName(options.colormap);
  if (!palette) return tl::unexpected(palette.error());
  Rendering rendering;
  Report& report = rendering.report;
  beginReport(kept, report);
  const Stopwatch order_watch;
  if (auto colored = colorPicture(sites, options, machine.threads, kept); !colored) {
    return tl::unexpected(colored.error());
  }
  rendering.key = kept.colors->key;
  auto& [cells, run, scene] = kept.found;
  const SiteSet& set = run->prepared.set;
  const auto& palette_indices = kept.colors->index;
  const ShownPart shown = shownPart(scene, options, run->prepared.exponent);
  WhatToDraw what = whatToDraw(set, options, shown);
  report.time_ms.order += 1e3 * order_watch.seconds();

  CellDrawing drawing({machine.backend, run->judge, set, options.search, machine.threads, options.progress},
                      palette_indices, std::move(what), kept.before);
  const NearestSites nearest{run->judge, set, palette_indices, scene.sitesOr(sites).size(), machine.threads};
  const auto room = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  auto picture = drawParts(machine.backend, drawing, nearest, shown, *palette, room);
  if (!picture) return tl::unexpected(picture.error());
  rendering.image = std::move(picture->image);
  finish(sites, kept, options, machine.threads, rendering.image);

  report.time_ms.download = 1e3 * picture->download_seconds;
  report.pixels = picture->uncovered;
  drawing.describe(report);
  rendering.status = kept.hasCells() ? cells.status : drawnStatuses(set, scene, kept.before.status);
  countStatuses(rendering.status, report);
  rendering.owner = kept.hasCells() ? cells.owner : run->prepared.owner;
  rendering.owner.resize(scene.imaged.count);
  kept.before.done = true;
  nameDevice(machine.backend, report);
  return rendering;
}

Result<void> checkRender(const RenderOptions& options) {
  if (auto checked = checkPicture(options); !checked) return checked;
  if (const auto palette = paletteByName(options.colormap); !palette) return tl::unexpected(palette.error());
  return {};
}

Result<Rendering> renderOn(const Machine& machine, const Sites& sites, const RenderOptions& options) {
  if (auto checked = checkRender(options); !checked) return tl::unexpected(checked.error());
  const auto with_cells = needsCells(sites, options, machine.threads);
  if (!with_cells) return tl::unexpected(with_cells.error());
  auto kept = findPicture(machine, sites, options, *with_cells);
  if (!kept) return tl::unexpected(kept.error());
  return renderKept(machine, sites, options, *kept);
}

}  // namespace vorpipe::core
