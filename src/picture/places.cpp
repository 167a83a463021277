#include <algorithm>
#include <array>
#include <cmath>

#include "vorpipe.h"
#include "vorpipe/shapes.h"

namespace vorpipe {
namespace {

/// The visible copies of something along an axis, as numbers of periods.
struct Copies {
  int first = 0, last = 0;
};

/// Returns the copies of an interval from `low` to `high` that meet the part from `begin` to `end`.
Copies copiesOf(double low, double high, double begin, double end, double period) {
  return {static_cast<int>(std::ceil((begin - high) / period)),
          static_cast<int>(std::floor((end - low) / period))};
}

}  // namespace

PicturePlaces::PicturePlaces(const RenderOptions& options)
    : view_(shownBox(options)),
      shown_{std::max(view_.xmin, options.domain.xmin), std::max(view_.ymin, options.domain.ymin),
             std::min(view_.xmax, options.domain.xmax), std::min(view_.ymax, options.domain.ymax)},
      frame_(shownFrame(options)) {}

Point PicturePlaces::pixelOf(Point place) const {
  return {frame_.left + (place.x - view_.xmin) / (view_.xmax - view_.xmin) * frame_.width,
          frame_.top + (view_.ymax - place.y) / (view_.ymax - view_.ymin) * frame_.height};
}

Box PicturePlaces::pixels() const {
  const Point first = pixelOf({shown_.xmin, shown_.ymax}), last = pixelOf({shown_.xmax, shown_.ymin});
  return {first.x, first.y, last.x, last.y};
}

double PicturePlaces::pixelsOf(double area) const {
  return area / (view_.ymax - view_.ymin) * (frame_.width / (view_.xmax - view_.xmin) * frame_.height);
}

std::vector<Point> shownCopies(const Box& box, const RenderOptions& options, const PicturePlaces& places) {
  const Box &domain = options.domain, &shown = places.shown();
  if (options.periodic == Periodic::none) {
    const bool misses =
        box.xmin > shown.xmax || box.xmax < shown.xmin || box.ymin > shown.ymax || box.ymax < shown.ymin;
    if (misses && options.view) return {};
    return {Point{0, 0}};
  }
  const double width = domain.xmax - domain.xmin, height = domain.ymax - domain.ymin;
  Copies columns, rows;
  if (options.periodic != Periodic::y) columns = copiesOf(box.xmin, box.xmax, shown.xmin, shown.xmax, width);
  if (options.periodic != Periodic::x) rows = copiesOf(box.ymin, box.ymax, shown.ymin, shown.ymax, height);
  std::vector<Point> copies;
  for (int row = rows.first; row <= rows.last; ++row) {
    for (int column = columns.first; column <= columns.last; ++column) {
      copies.push_back({column * width, row * height});
    }
  }
  return copies;
}

bool drawsEdge(const Cell& cell, std::size_t edge) {
  const auto here = static_cast<std::int64_t>(cell.index()), there = cell.neighbors()[edge];
  if (here != there) return here < there;
  // A cell that meets its own image has the edge twice, once from either side.
  return cell.shifts()[edge] > std::array<std::int32_t, 2>{};
}

}  // namespace vorpipe
