#include "globe/chart.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"
#include "domain/degrees.h"
#include "vorpipe/maps.h"

namespace vorpipe::core {
namespace {

/// How far polygons of one chart reach from its center, in degrees. Its plane reaches 29 Earth radii then.
constexpr double farthest_of_chart = 88;

double reachFrom(const Direction& center, const Outline& outline, std::size_t polygon) {
  double reach = 0;
  for (auto r = outline.polygon_offsets[polygon]; r < outline.polygon_offsets[polygon + 1]; ++r) {
    for (const Point place : ringAt(outline, r)) {
      reach = std::max(reach, angleBetween(center, directionOf(place)) / degree);
    }
  }
  return reach;
}

void addPolygon(const Outline& from, std::size_t polygon, Outline& outline) {
  if (outline.ring_offsets.empty()) outline.ring_offsets = outline.polygon_offsets = {0};
  for (auto r = from.polygon_offsets[polygon]; r < from.polygon_offsets[polygon + 1]; ++r) {
    const auto ring = ringAt(from, r);
    outline.points.insert(outline.points.end(), ring.begin(), ring.end());
    outline.ring_offsets.push_back(outline.points.size());
  }
  outline.polygon_offsets.push_back(outline.ring_offsets.size() - 1);
}

}  // namespace

Chart::Chart(Point center)
    : center_(directionOf(center)), right_(perpendicular(center_)), up_(cross(center_, right_)) {}

Point Chart::toPlane(const Direction& at) const {
  const double depth = dot(center_, at);
  return {dot(right_, at) / depth, dot(up_, at) / depth};
}

Direction Chart::toDirection(Point at) const { return normalized(center_ + at.x * right_ + at.y * up_); }

Sites Chart::toPlane(const SphereSites& sites, int threads) const {
  constexpr std::size_t grain = std::size_t{1} << 14;
  const auto count = sites.direction.size();
  Sites plane;
  for (auto* list : {&plane.x, &plane.y, &plane.weight}) list->resize(count);
  parallelFor(count, grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      const Direction way = sites.direction[i] - center_;
      const double excess = sites.excessOf(i), longer = 1 + excess;
      const double rise = longer * dot(way, way) / 2;
      plane.x[i] = longer * dot(right_, way);
      plane.y[i] = longer * dot(up_, way);
      // |v|^2 across the center's direction, plus 2 v along it, less 2.
      plane.weight[i] = 2 * excess * (1 + rise) - rise * rise;
    }
  });
  return plane;
}

Result<std::vector<ChartedOutline>> chartsOf(const Outline& outline) {
  VORPIPE_LET(amid, projectionAmid(outline));
  const auto polygons = outline.polygon_offsets.size() - 1;
  std::vector<ChartedOutline> charts;
  std::vector<std::uint8_t> is_taken(polygons);
  const auto addChart = [&](Point center) {
    const Direction direction = directionOf(center);
    ChartedOutline chart{center, {}};
    for (std::size_t p = 0; p < polygons; ++p) {
      if (is_taken[p] != 0 || reachFrom(direction, outline, p) > farthest_of_chart) continue;
      is_taken[p] = 1;
      addPolygon(outline, p, chart.degrees);
    }
    if (!chart.degrees.empty()) charts.push_back(std::move(chart));
  };
  addChart(amid.center());
  for (std::size_t p = 0; p < polygons; ++p) {
    if (is_taken[p] != 0) continue;
    Outline alone;
    addPolygon(outline, p, alone);
    VORPIPE_LET(around, projectionAmid(alone));
    addChart(around.center());
    if (is_taken[p] != 0) continue;
    return tl::unexpected(
        refusalOf(Subject::outline,
                  fmt::format("polygon {} reaches {:.0f} degrees from its center {}, {}; on the globe "
                              "a polygon reaches at most {:.0f}",
                              p, reachFrom(directionOf(around.center()), outline, p), around.center().x,
                              around.center().y, farthest_of_chart)));
  }
  return charts;
}

Result<Outline> outlineIn(const Chart& chart, const ChartedOutline& charted) {
  VORPIPE_LET(projection, Projection::around(charted.center));
  VORPIPE_VAR(plane, toPlane(projection, charted.degrees));
  for (Point& point : plane.points) point = chart.toPlane(directionOf(projection.toDegrees(point)));
  // It was valid in degrees: what is to be mended is rounding.
  VORPIPE_VAR(valid, mended(plane, true));
  return std::move(valid.outline);
}

Result<std::vector<SpherePolygon>> spherePolygonsOf(const Outline& outline) {
  VORPIPE_LET(charts, chartsOf(outline));
  std::vector<SpherePolygon> polygons;
  for (const ChartedOutline& charted : charts) {
    const Chart chart(charted.center);
    VORPIPE_LET(plane, outlineIn(chart, charted));
    VORPIPE_LET(rings, ringsOf(plane, 0));
    for (std::uint32_t r = 0; r + 1 < rings.offsets.size(); ++r) {
      if (rings.isOuter(r)) polygons.emplace_back();
      auto& ring = polygons.back().emplace_back();
      for (auto k = rings.offsets[r]; k < rings.offsets[r + std::size_t{1}]; ++k)
        ring.push_back(chart.toDirection(rings.points[k]));
    }
  }
  return polygons;
}

}  // namespace vorpipe::core
