#include "geometry/vertex_position.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/double_double.h"
#include "base/processors.h"
#include "geometry/polygon_measures.h"
#include "geometry/power_center.h"

namespace vorpipe::core {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr AnchoredPoint nowhere{{not_a_number, not_a_number}, {0, 0}};
/// A corner's error relative to its distance from the nearer two of its three sites. powerCenter loses at
/// most three bits to cancellation; its anchor, opposite the longest side, is one of the two sites that are
/// nearest to each other.
constexpr double relative_rounding = 0x1p-46;
/// In scaled units. A center farther away is found in double-double, so that its error no longer grows with
/// the distance.
constexpr double far = 8, farthest_rounded = 8 * far;

double weightOf(const SiteSet& s, std::int32_t i) {
  return s.weight.empty() ? 0 : s.weight[static_cast<std::size_t>(i)];
}

Point siteAt(const SiteSet& s, std::int32_t i) {
  return {s.x[static_cast<std::size_t>(i)], s.y[static_cast<std::size_t>(i)]};
}

std::uint32_t idOf(const SiteSet& s, std::int32_t i) { return s.id[static_cast<std::size_t>(i)]; }

WeightedPoint weightedSite(const SiteSet& s, std::int32_t i) { return {siteAt(s, i), weightOf(s, i)}; }

double squaredDistance(Point a, Point b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  return dx * dx + dy * dy;
}

FOR_FUSED_TOO AnchoredPoint wideCenterOf(const Triple& t) { return wideCenterOf(t.i, t.j, t.k); }

/// The y at which the bisector of i and j meets the wall x = at, in double-double.
DoubleDouble wideCrossing(const WeightedPoint& i, const WeightedPoint& j, double at) {
  const auto halved = [](DoubleDouble a) { return DoubleDouble{a.high / 2, a.low / 2}; };
  const DoubleDouble dx = DoubleDouble::sum(j.x, -i.x), dy = DoubleDouble::sum(j.y, -i.y);
  const DoubleDouble half = halved(dx * dx + dy * dy + DoubleDouble::sum(i.weight, -j.weight));
  return DoubleDouble(i.y) + (half - DoubleDouble::sum(at, -i.x) * dx) / dy;
}

/// The same as the sum of i.y and a double. Uses double-double if the terms of that double are much larger
/// than the distance from the nearer site: the bisector is nearly parallel to the wall, or sites have
/// weights.
DoubleDouble crossing(const WeightedPoint& i, const WeightedPoint& j, double at, bool weighted) {
  const double dx = j.x - i.x, dy = j.y - i.y;
  const double way = (at - i.x) * dx;
  const double half = 0.5 * (dx * dx + dy * dy),
               weight_difference = weighted ? 0.5 * (i.weight - j.weight) : 0;
  const double along = weighted ? (half + weight_difference - way) / dy : (half - way) / dy;
  const double from_i = std::abs(at - i.x) + std::abs(along);
  const double from_j = std::abs(at - j.x) + std::abs((i.y - j.y) + along);
  const double length = std::min(from_i, from_j);
  const double terms = (half + std::abs(weight_difference) + std::abs(way)) / std::abs(dy);
  if (terms < most_terms * length && length < far) return {i.y, along};
  const DoubleDouble wide = wideCrossing(i, j, at);
  return std::isfinite(wide.high) ? wide : DoubleDouble{i.y, along};
}

/// Where the bisector of two sites meets a wall.
AnchoredPoint atWall(const SiteSet& s, std::int32_t a, std::int32_t b, std::int32_t wall) {
  const auto i = weightedSite(s, a), j = weightedSite(s, b);
  const double at = wallCoordinate(s.domain, wall);
  const bool weighted = !s.weight.empty();
  const auto swapped = [](const WeightedPoint& p) { return WeightedPoint{{p.y, p.x}, p.weight}; };
  if (isVerticalWall(wall)) {
    const DoubleDouble y = crossing(i, j, at, weighted);
    return {{at, y.high}, {0, y.low}};
  }
  const DoubleDouble x = crossing(swapped(i), swapped(j), at, weighted);
  return {{x.high, at}, {x.low, 0}};
}

/// The distance from a corner to the second nearest of the sites around it; at a wall, to the nearest.
double nearestTwo(const SiteSet& s, const std::array<std::int32_t, 3>& around, const AnchoredPoint& corner) {
  double nearest = std::numeric_limits<double>::infinity(), second = nearest;
  for (const auto i : around) {
    if (i < 0) continue;
    const Point way = relativeTo(siteAt(s, i), corner);
    const double away = std::abs(way.x) + std::abs(way.y);
    second = std::min(second, std::max(nearest, away));
    nearest = std::min(nearest, away);
  }
  return std::ranges::min(around) < 0 ? nearest : second;
}

}  // namespace

bool isVerticalWall(std::int32_t wall) { return wall == wall_xmin || wall == wall_xmax; }

double wallCoordinate(const Box& domain, std::int32_t wall) {
  if (wall == wall_xmin) return domain.xmin;
  if (wall == wall_xmax) return domain.xmax;
  return wall == wall_ymin ? domain.ymin : domain.ymax;
}

AnchoredPoint cornerPosition(const SiteSet& sites, std::int32_t cell, std::int32_t before,
                             std::int32_t after) {
  if (before < 0 && after < 0) {
    if (isVerticalWall(before) == isVerticalWall(after)) return nowhere;
    const auto vertical = isVerticalWall(before) ? before : after;
    const auto level = isVerticalWall(before) ? after : before;
    return {{wallCoordinate(sites.domain, vertical), wallCoordinate(sites.domain, level)}, {0, 0}};
  }
  if (before < 0 || after < 0) {
    const auto other = std::max(before, after);
    const auto wall = std::min(before, after);
    return idOf(sites, cell) < idOf(sites, other) ? atWall(sites, cell, other, wall)
                                                  : atWall(sites, other, cell, wall);
  }
  const auto i = weightedSite(sites, cell), p = weightedSite(sites, before), j = weightedSite(sites, after);
  const auto center = sites.weight.empty()
                          ? powerCenter<false>(i.x, i.y, 0, p.x, p.y, 0, j.x, j.y, 0)
                          : powerCenter<true>(i.x, i.y, i.weight, p.x, p.y, p.weight, j.x, j.y, j.weight);
  if (center.sure != 0) return {{center.base_x, center.base_y}, {center.rest_x, center.rest_y}};
  return wideCenterOf(tripleOf(sites, cell, before, after));
}

Triple tripleOf(const SiteSet& sites, std::int32_t a, std::int32_t b, std::int32_t c) {
  std::array<std::int32_t, 3> sorted{a, b, c};
  std::sort(sorted.begin(), sorted.end(),
            [&](std::int32_t m, std::int32_t n) { return idOf(sites, m) < idOf(sites, n); });
  Triple t{weightedSite(sites, sorted[0]), weightedSite(sites, sorted[1]), weightedSite(sites, sorted[2])};
  const double ij = squaredDistance(t.i, t.j);
  const double jk = squaredDistance(t.j, t.k);
  const double ik = squaredDistance(t.i, t.k);
  if (ik > jk && ik >= ij) {
    std::swap(t.i, t.j);
  } else if (ij > jk) {
    std::swap(t.i, t.k);
  }
  return t;
}

void placeCorners(const SiteSet& sites, std::size_t cell, std::span<const std::int32_t> row,
                  std::vector<AnchoredPoint>& corners) {
  corners.clear();
  auto before = row.empty() ? 0 : row.back();
  for (const auto neighbor : row) {
    corners.push_back(cornerPosition(sites, static_cast<std::int32_t>(cell), before, neighbor));
    before = neighbor;
  }
}

EdgeSpan edgeSpan(const SiteSet& sites, std::int32_t cell, std::int32_t before, std::int32_t neighbor,
                  std::int32_t after, const AnchoredPoint& begin, const AnchoredPoint& end, double shortest) {
  const Point site = siteAt(sites, cell);
  const Point way = wayBetween(begin, end);
  const double reach =
      (nearestTwo(sites, {cell, before, neighbor}, begin) + nearestTwo(sites, {cell, neighbor, after}, end)) +
      (std::abs(way.x) + std::abs(way.y));
  const double rounding = relative_rounding * std::min(reach, farthest_rounded);
  if (neighbor < 0) {
    const double along = outward(neighbor) * (isVerticalWall(neighbor) ? way.y : -way.x);
    return {along - rounding, 2 * rounding, 2 * rounding, false};
  }
  const Point other = siteAt(sites, neighbor);
  const double dx = other.x - site.x, dy = other.y - site.y;
  const double distance = lengthOf({dx, dy});
  const double shorter_side = shorterSide(sites);
  const double tie = shortest * tieScale(distance, shorter_side), slack = tie + rounding;
  const double excess = shortest < shortest_edge ? (dx * way.y - dy * way.x) - slack * distance
                                                 : excessLength(dx, dy, way.x, way.y, shorter_side);
  return {excess, slack * distance, slack, rounding > tie};
}

}  // namespace vorpipe::core
