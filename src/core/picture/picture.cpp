#include "core/picture/picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>

#include "base/inside.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "core/cells/cells_run.h"
#include "core/drawing/cell_drawing.h"
#include "core/outline/edge_tree.h"
#include "core/outline/pixel_mask.h"
#include "core/periodic/scene.h"
#include "core/picture/colormap.h"
#include "core/picture/draw_legend.h"
#include "core/picture/draw_marks.h"
#include "core/picture/frame.h"
#include "core/picture/palette_index.h"
#include "core/picture/uncovered.h"
#include "core/sites/bin_sort.h"
#include "core/sites/weights.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t grain = 1 << 12;

/// One view of a picture that is drawn in parts: its place in the image, rows from the bottom.
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

Box scaled(const Box& box, int exponent) {
  const PowerOfTwo scale(exponent);
  return {scale(box.xmin), scale(box.ymin), scale(box.xmax), scale(box.ymax)};
}

/// Seen from the corner of the domain.
Box boxOf(const Part& part, const Box& domain, int width, int height) {
  const auto x = [&](int column) { return (domain.xmax - domain.xmin) * column / width; };
  const auto y = [&](int row) { return (domain.ymax - domain.ymin) * row / height; };
  return {x(part.column), y(part.row), x(part.column + part.width), y(part.row + part.height)};
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

/// Whether all sites lie in the domain and inside the outline. Each position then has a cell of which the
/// outline leaves something.
bool areInside(const Sites& sites, const Box& domain, const Rings& rings, int exponent, int threads) {
  const OutlineIndex index(rings);
  const PowerOfTwo scale(exponent);
  std::atomic<bool> all = true;
  parallelFor(sites.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end && all; ++i) {
      const double x = sites.x[i], y = sites.y[i];
      if (!isInside(domain, x, y) || !index.contains({scale(x), scale(y)})) all = false;
    }
  });
  return all;
}

/// Whether the cells are to be found as data: for measures that the colors follow, and to prove which cells
/// weights and an outline leave.
bool needsCells(const Machine& machine, const Sites& sites, const RenderOptions& options,
                const Rings& rings) {
  if (options.color == ColorBy::area || options.color == ColorBy::neighbors || hasWeights(sites)) return true;
  return !options.outline.empty() &&
         !areInside(sites, options.domain, rings, scaleExponent(options.domain), machine.threads);
}

/// What the picture is drawn from: the cells, or prepared sites alone.
Result<FoundCells> findWhatToDraw(const Machine& machine, const Sites& sites, const RenderOptions& options,
                                  const Rings& rings) {
  if (needsCells(machine, sites, options, rings)) {
    CellsOptions cells = cellsOptions(options);
    cells.detail = marksDetail(options);
    return findCells(machine, sites, cells, ImagesFor::pictures);
  }
  const Stopwatch watch;
  FoundCells found;
  auto scene = sceneOf(sites, options, machine.threads);
  if (!scene) return tl::unexpected(scene.error());
  found.scene = std::move(*scene);
  const CallersSites callers{sites, [&](std::uint32_t i) { return found.scene.siteOf(i); },
                             found.scene.picture};
  auto run = beginRun(machine, found.scene.sitesOr(sites), found.scene.clip, &callers);
  if (!run) return tl::unexpected(run.error());
  found.run = std::move(*run);
  found.diagram.report.time_ms.order = 1e3 * watch.seconds();
  return found;
}

/// What is drawn over cells as data. Cells that the picture is not drawn from are found apart, so that marks
/// change no pixel's site.
Result<Marks> findMarks(const Machine& machine, const Sites& sites, const RenderOptions& options,
                        FoundCells& found) {
  if (!marksNeedCells(options)) return Marks{};
  if (!found.diagram.status.empty()) return marksOf(sites, found.diagram, options, machine.threads);
  CellsOptions cells = cellsOptions(options);
  cells.detail = marksDetail(options);
  const auto diagram = cellsOn(machine, sites, cells);
  if (!diagram) return tl::unexpected(diagram.error());
  found.diagram.report.time_ms.cells = diagram->report.time_ms.cells;
  return marksOf(sites, *diagram, options, machine.threads);
}

/// What was drawn of a picture, and how.
struct Drawn {
  Image image;
  double download_seconds = 0;
  std::uint64_t uncovered = 0;  ///< pixels that the device left
};

/// `box` is what the picture shows, in the units of the set; `room` is how many pixels it will have.
Result<Drawn> drawParts(Backend& backend, CellDrawing& drawing, const NearestSites& nearest, const Box& box,
                        const Palette& palette, PictureSize size, std::size_t room) {
  const auto [width, height] = size;
  Drawn drawn{{width, height, {}, {}}};
  Image& image = drawn.image;
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  image.rgba.reserve(room);
  image.ids.reserve(room);
  image.rgba.resize(pixels);
  image.ids.resize(pixels);
  std::vector<std::uint32_t> rgba;
  std::vector<std::uint32_t> ids;
  for (const auto& part : partsOf(width, height, backend.info().max_view)) {
    const View view{boxOf(part, box, width, height), part.width, part.height, palette, {box.xmin, box.ymin}};
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
  return drawn;
}

/// Of cells without fill.
Palette whitePalette() {
  Palette palette;
  palette.fill(white);
  return palette;
}

/// Palette indices by index in the set, from those by the caller's site.
std::vector<std::uint8_t> indicesInSet(const SiteSet& set, const Scene& scene,
                                       const std::vector<std::uint8_t>& by_site) {
  std::vector<std::uint8_t> indices(set.size());
  std::ranges::transform(set.id, indices.begin(),
                         [&](std::uint32_t id) { return by_site[scene.siteOf(id)]; });
  return indices;
}

/// Which sites of a set have no cell, if `cells` say it: a device does not see whether the cell of a site
/// with weights is very small or empty.
std::vector<std::uint8_t> hiddenSites(const SiteSet& set, const Scene& scene, const Diagram& cells) {
  if (set.weight.empty()) return {};
  std::vector<std::uint8_t> hidden(set.size());
  std::transform(set.id.begin(), set.id.end(), hidden.begin(), [&](std::uint32_t id) {
    return cells.status[scene.siteOf(id)] == Status::empty ? std::uint8_t{1} : std::uint8_t{0};
  });
  return hidden;
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

/// Takes over what the cells took, to which the drawing adds.
void beginReport(const Report& cells, Report& report) {
  report.hidden = cells.hidden;
  report.retried = cells.retried;
  report.in_double = cells.in_double;
  report.exact = cells.exact;
  report.time_ms = cells.time_ms;
  report.validation_messages = cells.validation_messages;
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

Result<Rendering> renderOn(const Machine& machine, const Sites& sites, const RenderOptions& options) {
  if (auto checked = checkPicture(options); !checked) return tl::unexpected(checked.error());
  const auto colormap = paletteByName(options.colormap);
  if (!colormap) return tl::unexpected(colormap.error());
  const auto rings = ringsOf(options.outline, scaleExponent(options.domain));
  if (!rings) return tl::unexpected(rings.error());
  auto found = findWhatToDraw(machine, sites, options, *rings);
  if (!found) return tl::unexpected(found.error());
  auto marks = findMarks(machine, sites, options, *found);
  if (!marks) return tl::unexpected(marks.error());
  auto& [cells, run, scene] = *found;

  Rendering rendering;
  auto& report = rendering.report;
  auto& times = report.time_ms;
  beginReport(cells.report, report);
  const Stopwatch order_watch;
  SiteSet& set = run->prepared.set;
  auto colors = paletteIndices(sites, cells, options, machine.threads);
  if (!colors) return tl::unexpected(colors.error());
  rendering.key = std::move(colors->key);
  const auto palette_indices = indicesInSet(set, scene, colors->index);
  times.order += 1e3 * order_watch.seconds();

  if (run->cells) set.hidden = hiddenSites(set, scene, cells);
  CellDrawing drawing({machine.backend, run->judge, set, options.search, machine.threads, options.progress},
                      palette_indices, std::move(run->cells));
  const Sites& drawn = scene.sitesOr(sites);
  const NearestSites nearest{run->judge, set, palette_indices, drawn.size(), machine.threads};
  const int exponent = run->prepared.exponent;
  const PictureFrame frame = frameOf(options.domain, options.width, options.height, options.fit);
  const auto room = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  const Palette palette = options.fill ? *colormap : whitePalette();
  const auto draw_cells = [&](const Box& box, PictureSize size, std::size_t pixels) -> Result<Drawn> {
    auto cells_drawn =
        drawParts(machine.backend, drawing, nearest, scaled(box, exponent), palette, size, pixels);
    if (cells_drawn && !options.outline.empty()) {
      maskOutside(*rings, box, exponent, machine.threads, cells_drawn->image);
    }
    return cells_drawn;
  };
  auto picture = draw_cells(scene.picture, {frame.width, frame.height}, room);
  if (!picture) return tl::unexpected(picture.error());
  rendering.image = std::move(picture->image);
  Image& image = rendering.image;
  const auto draw_places = [&](const Box& box, PictureSize size) {
    return draw_cells(box, size, 0).map([](Drawn&& places) { return std::move(places.image); });
  };
  const Overlays overlays{options, *marks, drawn, scene.picture, machine.threads};
  if (auto over = drawOverlays(overlays, draw_places, image); !over) return tl::unexpected(over.error());
  nameSites(scene, image.ids);
  putIntoFrame(frame, options.width, options.height, image);
  drawLabels(
      *marks, options, [&](std::uint32_t site) { return palette[colors->index[site]]; }, image);
  if (options.legend) {
    drawLegend(legendOf(*rendering.key, options.colormap, options.width, options.height), image);
  }

  times.download = 1e3 * picture->download_seconds;
  report.pixels = picture->uncovered;
  drawing.describe(report);
  const bool has_cells = !cells.status.empty();
  rendering.status = has_cells ? std::move(cells.status) : drawnStatuses(set, scene, drawing.status());
  countStatuses(rendering.status, report);
  rendering.owner = std::move(has_cells ? cells.owner : run->prepared.owner);
  rendering.owner.resize(scene.imaged.count);
  nameDevice(machine.backend, report);
  return rendering;
}

}  // namespace vorpipe::core
