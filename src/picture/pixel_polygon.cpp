#include "picture/pixel_polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "backend/precision.h"

namespace vorpipe::core {
namespace {

/// In pixels: distance that rounding may put between an edge and a center on it.
constexpr double on_edge = 1e-9;

/// Distance beyond the view at which polygons are cut, in sizes of the view.
constexpr double kept_beyond = 0.5;

/// Returns where an edge crosses a line along the other axis. The result does not depend on the order of the
/// ends.
double crossingOf(double at, Point a, Point b, double Point::*along, double Point::*across) {
  if (b.*along < a.*along || (b.*along == a.*along && b.*across < a.*across)) std::swap(a, b);
  const double part = (at - a.*along) / (b.*along - a.*along);
  return a.*across + part * (b.*across - a.*across);
}

/// Cuts away the side of the line where a coordinate is `at`: above, or else below.
void cutAt(double at, bool above, double Point::*along, double Point::*across, std::vector<Point>& polygon) {
  const auto isKept = [&](Point p) { return above ? p.*along <= at : p.*along >= at; };
  if (std::ranges::all_of(polygon, isKept)) return;
  std::vector<Point> kept;
  Point before = polygon.back();
  for (const Point corner : polygon) {
    if (isKept(before) != isKept(corner)) {
      Point crossing;
      crossing.*along = at;
      crossing.*across = crossingOf(at, before, corner, along, across);
      kept.push_back(crossing);
    }
    if (isKept(corner)) kept.push_back(corner);
    before = corner;
  }
  polygon = std::move(kept);
}

double crossOf(Point a, Point b, Point p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

/// Whether p is inside, or beyond an edge by no more than `moved` along each axis.
bool contains(const std::vector<Point>& polygon, Point p, double moved) {
  Point before = polygon.back();
  for (const Point corner : polygon) {
    if (crossOf(before, corner, p) <
        -moved * (std::abs(corner.x - before.x) + std::abs(corner.y - before.y))) {
      return false;
    }
    before = corner;
  }
  return true;
}

}  // namespace

PixelFrame::PixelFrame(const View& view, int subpixel_bits)
    : low_{view.box.xmin, view.box.ymin},
      scale_{view.width / (view.box.xmax - view.box.xmin), view.height / (view.box.ymax - view.box.ymin)},
      size_{static_cast<double>(view.width), static_cast<double>(view.height)} {
  const int longer = std::max(view.width, view.height);
  const double dilation = pixelShares(longer, longer, subpixel_bits).outset();
  erosion_ = std::max(0.0, -dilation);
  moved_ = std::max(on_edge, dilation);
}

void cutToView(const PixelFrame& frame, std::vector<Point>& polygon) {
  const Point size = frame.size();
  const double wide = kept_beyond * size.x, high = kept_beyond * size.y;
  if (!polygon.empty()) cutAt(-wide, false, &Point::x, &Point::y, polygon);
  if (!polygon.empty()) cutAt(size.x + wide, true, &Point::x, &Point::y, polygon);
  if (!polygon.empty()) cutAt(-high, false, &Point::y, &Point::x, polygon);
  if (!polygon.empty()) cutAt(size.y + high, true, &Point::y, &Point::x, polygon);
}

CoveredPixels coveredPixels(const std::vector<Point>& polygon, const PixelFrame& frame) {
  using Count = CoveredPixels::Count;
  if (polygon.empty()) return {Count::none, {}};
  Point low = polygon.front(), high = low;
  for (const Point corner : polygon) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  const double west = std::max(0.0, std::ceil(low.x - 0.5 - frame.moved()));
  const double south = std::max(0.0, std::ceil(low.y - 0.5 - frame.moved()));
  const double east = std::min(frame.size().x - 1, std::floor(high.x - 0.5 + frame.moved()));
  const double north = std::min(frame.size().y - 1, std::floor(high.y - 0.5 + frame.moved()));
  if (west > east || south > north) return {Count::none, {}};
  if (east - west > 1 || north - south > 1) return {Count::several, {}};
  CoveredPixels covered{Count::none, {}};
  for (double row = south; row <= north; ++row) {
    for (double column = west; column <= east; ++column) {
      const Point center{column + 0.5, row + 0.5};
      if (!contains(polygon, center, frame.moved())) continue;
      if (covered.count == Count::one) return {Count::several, {}};
      covered = {Count::one, center};
    }
  }
  return covered;
}

bool shrink(double erosion, std::vector<Point>& polygon) {
  Point middle{0, 0};
  for (const Point corner : polygon) middle = {middle.x + corner.x, middle.y + corner.y};
  const auto corners = static_cast<double>(polygon.size());
  middle = {middle.x / corners, middle.y / corners};
  double factor = 1;
  Point before = polygon.back();
  for (const Point corner : polygon) {
    const double sides = std::abs(corner.x - before.x) + std::abs(corner.y - before.y);
    if (sides > 0) factor = std::min(factor, 1 - erosion * sides / crossOf(before, corner, middle));
    before = corner;
  }
  if (!(factor > 0)) return false;
  for (Point& corner : polygon) {
    corner = {middle.x + factor * (corner.x - middle.x), middle.y + factor * (corner.y - middle.y)};
  }
  return true;
}

}  // namespace vorpipe::core
