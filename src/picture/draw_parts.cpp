#include "picture/draw_parts.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "base/try.h"
#include "picture/near_view.h"

namespace vorpipe::core {
namespace {

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

View viewOf(const ShownPart& shown, const Part& part, const Palette& palette) {
  return {shown.boxOf(part.column, part.row, part.width, part.height),
          part.width,
          part.height,
          palette,
          {shown.box.xmin, shown.box.ymin}};
}

}  // namespace

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
    VORPIPE_TRY(drawing.draw(view));
    rgba.resize(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
    ids.resize(rgba.size());
    Stopwatch watch;
    VORPIPE_TRY(drawing.read(view, rgba, ids));
    drawn.uncovered += coverRest(nearest, view, rgba, ids);
    place(part, rgba, image, image.rgba);
    place(part, ids, image, image.ids);
    drawn.download_seconds += watch.seconds();
  }
  if (pixels == 0) {
    VORPIPE_TRY(drawing.findStatuses());
  }
  return drawn;
}

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

}  // namespace vorpipe::core
