#include "check/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check/places.h"

namespace vorpipe::core::checks {

CheckedOutline::CheckedOutline(const CheckedSites& run) : run_(run) {
  const Outline& outline = *run.outline;
  std::size_t ring = 0;
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    for (const std::size_t first = ring; ring < outline.polygon_offsets[p + 1]; ++ring) {
      std::vector<Point> points;
      for (auto k = outline.ring_offsets[ring]; k < outline.ring_offsets[ring + 1]; ++k) {
        points.push_back({countedCoordinate(outline.points[k].x * run.scale) - run.base.x,
                          countedCoordinate(outline.points[k].y * run.scale) - run.base.y});
      }
      if ((areaOf(points) > 0) != (ring == first)) std::ranges::reverse(points);
      for (std::size_t k = 0; k < points.size(); ++k)
        edges_.push_back({points[k], points[k + 1 < points.size() ? k + 1 : 0]});
    }
  }
  std::vector<Box> boxes;
  boxes.reserve(edges_.size());
  for (const auto& [a, b] : edges_) boxes.push_back(boxAround(a, b));
  tree_.emplace(std::move(boxes));
}

CheckedOutline::Side CheckedOutline::at(Point p, double slack) const {
  bool near = false;
  eachNear(p, slack, [&](std::uint32_t e) { near = near || distance(p, edges_[e].a, edges_[e].b) <= slack; });
  if (near) return Side::edge;
  bool inside = false;
  constexpr double farthest = std::numeric_limits<double>::infinity();
  eachMeeting({p.x, p.y, farthest, p.y},
              [&](std::uint32_t e) { inside = inside != crossesRay(p, edges_[e].a, edges_[e].b); });
  return inside ? Side::inside : Side::outside;
}

double CheckedOutline::area() const {
  double sum = 0, lost = 0;
  std::vector<Point> part;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    // The quadrangle between an edge and the line below it.
    const auto& [a, b] = edges_[e];
    const Box& box = run_.domain;
    const double low = std::min({a.y, b.y, box.ymin});
    part = {a, b, {b.x, low}, {a.x, low}};
    cutRing({-1, 0}, -box.xmin, part);
    cutRing({1, 0}, box.xmax, part);
    cutRing({0, -1}, -box.ymin, part);
    cutRing({0, 1}, box.ymax, part);
    const double area = areaOf(part);
    const double next = sum + area;
    lost += std::abs(sum) >= std::abs(area) ? (sum - next) + area : (area - next) + sum;
    sum = next;
  }
  return (sum + lost) / run_.scale / run_.scale;
}

double CheckedOutline::area(std::span<const Point> ring, Point origin) const {
  if (ring.empty()) return 0;
  const Box box = boxOf(ring);
  double sum = 0;
  std::vector<Point> part;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    // The part of the ring below an edge.
    Point a = edges_[e].a - origin, b = edges_[e].b - origin;
    const double sign = a.x > b.x ? 1 : -1;
    if (a.x > b.x) std::swap(a, b);
    if (!(a.x < b.x) || b.x <= box.xmin || a.x >= box.xmax || std::max(a.y, b.y) <= box.ymin) continue;
    part.assign(ring.begin(), ring.end());
    cutRing({-1, 0}, -a.x, part);
    cutRing({1, 0}, b.x, part);
    const Point way = b - a;
    const Point normal{-way.y / checks::length(way), way.x / checks::length(way)};
    cutRing(normal, dot(a, normal), part);
    sum += sign * areaOf(part);
  }
  return sum;
}

double CheckedOutline::length() const {
  double sum = 0;
  for (const auto& [a, b] : edges_) sum += checks::length(b - a);
  return sum;
}

}  // namespace vorpipe::core::checks
