#include "picture/draw_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "base/try.h"
#include "picture/font.h"
#include "picture/legend.h"
#include "picture/pixels.h"

namespace vorpipe::core {
namespace {

/// Edges along the outline use the pixels of its cells and as many outside as at other edges; the outer half
/// is hidden here.
double outlineWidth(const RenderOptions& options) { return options.edge_width + 1; }

/// Draws edges only in a part of an image: at the end of the domain, cells end but no others begin.
void drawEdgesIn(const PictureFrame& part, const RenderOptions& options, int threads, Image& image) {
  const double width = options.edge_width;
  const std::uint32_t color = edgeColor(options);
  if (part.width == image.width && part.height == image.height)
    return drawEdges(image, width, color, threads);
  if (part.width == 0) return;
  Image cut = partOf(image, part);
  drawEdges(cut, width, color, threads);
  putPart(cut, part, image);
}

/// Returns the mean color of the samples of a pixel (decision D106), by their opacities. Samples without a
/// site are transparent and do not affect the color.
std::uint32_t meanOf(const Image& samples, int row, int column, int in_pixel) {
  constexpr std::uint32_t opaque = 0xFF;
  std::array<std::uint32_t, 3> sums{};
  std::uint32_t covered = 0;  // in 255ths
  for (int y = row * in_pixel; y < (row + 1) * in_pixel; ++y) {
    for (int x = column * in_pixel; x < (column + 1) * in_pixel; ++x) {
      const auto at = pixelAt(samples, y, x);
      if (samples.ids[at] == no_site) continue;
      const std::uint32_t color = samples.rgba[at], alpha = color >> 24;
      covered += alpha;
      for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += alpha * (color >> 8 * c & opaque);
    }
  }
  if (covered == 0) return 0;
  const auto all = static_cast<std::uint32_t>(in_pixel * in_pixel);
  std::uint32_t mean = (covered + all / 2) / all << 24;
  for (std::size_t c = 0; c < sums.size(); ++c) mean |= (sums[c] + covered / 2) / covered << 8 * c;
  return mean;
}

/// Draws a dot smoothed, whatever is below.
void drawWholeDot(Point at, const DotSize& dot, std::uint32_t color, Image& image) {
  const auto first = [](double edge) { return static_cast<int>(std::floor(edge)); };
  for (int row = first(at.y - dot.radius); row <= first(at.y + dot.radius); ++row) {
    for (int column = first(at.x - dot.radius); column <= first(at.x + dot.radius); ++column) {
      const double distance = std::hypot(column + 0.5 - at.x, row + 0.5 - at.y);
      if (dot.rim > 0) blend(image, row, column, black, dot.radius - distance + 0.5);
      blend(image, row, column, color, dot.radius - dot.rim - distance + 0.5);
    }
  }
}

}  // namespace

Result<void> smooth(const DrawRows& draw, int in_pixel, int threads, Image& image) {
  const int step = rowsAtOnce(image.width, in_pixel);
  for (int first = 0; first < image.height; first += step) {
    const int last = std::min(image.height, first + step);
    VORPIPE_LET(samples, draw(first, last));
    constexpr std::size_t grain = 16;
    parallelFor(static_cast<std::size_t>(last - first), grain, threadsForSteps(samples.ids.size(), threads),
                [&](std::size_t begin, std::size_t end) {
                  for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
                    for (int column = 0; column < image.width; ++column) {
                      image.rgba[pixelAt(image, first + row, column)] =
                          meanOf(samples, row, column, in_pixel);
                    }
                  }
                });
  }
  return {};
}

Result<void> drawOverlays(const Overlays& overlays, const DrawRows& cells, Image& image) {
  const RenderOptions& options = overlays.options;
  const Marks& marks = overlays.marks;
  const int threads = overlays.threads;
  const PictureFrame frame = shownFrame(options);
  std::optional<SiteDots> dots;
  if (options.show_sites && !hasNames(options))
    dots.emplace(image, overlays.sites, overlays.box, options.dot_size);
  const auto draw_lines = [&](int first, int in_pixel, Image& into) {
    const SampleGrid samples{static_cast<double>(frame.left), static_cast<double>(frame.top + first),
                             in_pixel};
    drawLines(marks.edges, options.edge_width, edgeColor(options), samples, threads, into);
    drawLines(marks.outline, outlineWidth(options), edgeColor(options), samples, threads, into);
    drawLines(marks.borders, borderWidth(options), edgeColor(options), samples, threads, into);
    drawLines(marks.dual, options.edge_width, dual_color, samples, threads, into);
    if (dots) dots->draw({0, static_cast<double>(first), in_pixel}, dotColor(options), into);
  };
  const int in_pixel = options.antialias;
  if (in_pixel == 1) {
    if (options.edges) drawEdgesIn(overlays.domain, options, threads, image);
    draw_lines(0, 1, image);
    return {};
  }
  const auto draw = [&](int first, int last) -> Result<Image> {
    auto samples = cells(first, last);
    if (samples) draw_lines(first, in_pixel, *samples);
    return samples;
  };
  return smooth(draw, in_pixel, threads, image);
}

namespace {

void drawLabels(const Marks& marks, const RenderOptions& options, std::span<const std::uint32_t> colors,
                Image& image) {
  const double height = options.label_size, margin = labelMargin(options);
  for (const Point dot : marks.labels.dots) drawWholeDot(dot, marks.labels.dot, dotColor(options), image);
  for (const SiteLabel& label : marks.labels.labels) {
    const double left = label.middle.x - label.width / 2, top = label.middle.y - height / 2;
    const std::uint32_t cell = colors[label.site];
    // Dual lines end at sites, where labels are.
    if (options.dual && !label.beyond) {
      blendBox({left - margin, top - margin, left + label.width + margin, top + height + margin}, cell,
               image);
    }
    const auto [ink, halo] = colorsOf(label, options, cell);
    if (halo) drawTextAt(label.text, {left, top + height}, height, *halo, image, halo_part * letter_units);
    drawTextAt(label.text, {left, top + height}, height, ink, image);
  }
}

}  // namespace

void completePicture(const RenderOptions& options, const Marks& marks, std::span<const std::uint32_t> colors,
                     const std::optional<ColorKey>& key, int threads, Image& image) {
  putIntoFrame(shownFrame(options), options.width, options.height, image);
  if (options.background) layOver(options.background->rgba, image);
  blendLines(marks.graticule, options.edge_width, graticule_color, threads, image);
  drawLabels(marks, options, colors, image);
  if (options.legend && !options.legend_beside) drawLegend(legendOf(*key, options), image);
}

}  // namespace vorpipe::core
