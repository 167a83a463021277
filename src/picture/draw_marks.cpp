#include "picture/draw_marks.h"

#include <cmath>
#include <optional>

#include "picture/blend.h"
#include "picture/font.h"
#include "picture/frame.h"
#include "picture/smooth.h"

namespace vorpipe::core {
namespace {

/// Edges along the outline use the pixels of its cells and as many outside as at other edges; the outer half
/// is hidden here.
double outlineWidth(const RenderOptions& options) { return options.edge_width + 1; }

/// Darkens edges only in a part of an image: at the end of the domain, cells end but no others begin.
void drawEdgesIn(const PictureFrame& part, double width, int threads, Image& image) {
  if (part.width == image.width && part.height == image.height) return drawEdges(image, width, threads);
  if (part.width == 0) return;
  Image cut = partOf(image, part);
  drawEdges(cut, width, threads);
  putPart(cut, part, image);
}

}  // namespace

Result<void> drawOverlays(const Overlays& overlays, const DrawCells& cells, Image& image) {
  const RenderOptions& options = overlays.options;
  const Marks& marks = overlays.marks;
  const int threads = overlays.threads;
  const PictureFrame frame = shownFrame(options);
  std::optional<SiteDots> dots;
  if (options.show_sites) dots.emplace(image, overlays.sites, overlays.box, options.dot_size);
  const auto draw_lines = [&](int first, int in_pixel, Image& into) {
    const Places places{static_cast<double>(frame.left), static_cast<double>(frame.top + first), in_pixel};
    drawLines(marks.edges, options.edge_width, edge_color, places, threads, into);
    drawLines(marks.outline, outlineWidth(options), edge_color, places, threads, into);
    drawLines(marks.dual, options.edge_width, dual_color, places, threads, into);
    if (dots) dots->draw({0, static_cast<double>(first), in_pixel}, !options.fill, into);
  };
  const int in_pixel = options.antialias;
  if (in_pixel == 1) {
    if (options.edges) drawEdgesIn(overlays.domain, options.edge_width, threads, image);
    draw_lines(0, 1, image);
    return {};
  }
  const auto draw = [&](int first, int last) -> Result<Image> {
    auto places = cells(first, last);
    if (places) draw_lines(first, in_pixel, *places);
    return places;
  };
  return smooth(draw, in_pixel, threads, image);
}

void drawLabels(const Marks& marks, const RenderOptions& options, std::span<const std::uint32_t> colors,
                Image& image) {
  const double height = options.label_size, margin = labelMargin(options);
  for (const SiteLabel& label : marks.labels) {
    const double left = label.middle.x - label.width / 2, top = label.middle.y - height / 2;
    const std::uint32_t cell = colors[label.site];
    if (options.dual) {
      // Dual lines end at sites, where labels are.
      const auto pixel = [](double at) { return static_cast<int>(std::lround(at)); };
      for (int row = pixel(top - margin); row < pixel(top + height + margin); ++row) {
        for (int column = pixel(left - margin); column < pixel(left + label.width + margin); ++column) {
          blend(image, row, column, cell, 1);
        }
      }
    }
    drawTextAt(label.text, {left, top + height}, height, inkOn(cell), image);
  }
}

}  // namespace vorpipe::core
