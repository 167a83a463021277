#include "core/check/outline.h"

#include <algorithm>
#include <cmath>

#include "core/check/places.h"

namespace vorpipe::core::checks {

CheckedOutline::CheckedOutline(const CheckedSites& run) : run_(run), nodes_(2 * band_count) {
  const Outline& outline = *run.outline;
  low_ = run.domain.ymin;
  per_band_ = (run.domain.ymax - run.domain.ymin) / band_count;
  std::size_t ring = 0;
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    for (const std::size_t first = ring; ring < outline.polygon_offsets[p + 1]; ++ring) {
      std::vector<Point> points;
      for (auto k = outline.ring_offsets[ring]; k < outline.ring_offsets[ring + 1]; ++k) {
        points.push_back(
            {outline.points[k].x * run.scale - run.base.x, outline.points[k].y * run.scale - run.base.y});
      }
      const bool turned = (areaOf(points) > 0) != (ring == first);
      for (std::size_t k = 0; k < points.size(); ++k) {
        edges_.push_back({points[k], points[k + 1 < points.size() ? k + 1 : 0]});
        sign_.push_back(turned ? -1 : 1);
      }
    }
  }
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    const auto [low, high] = std::minmax(edges_[e].a.y, edges_[e].b.y);
    // Edges just beside a band belong to it too: a place there may be near them.
    addToBands(e, bandOf(low - per_band_), bandOf(high + per_band_));
  }
}

void CheckedOutline::addToBands(std::uint32_t edge, std::size_t first, std::size_t last) {
  std::size_t low = first + band_count, high = last + band_count + 1;
  for (; low < high; low /= 2, high /= 2) {
    if (low % 2 == 1) nodes_[low++].push_back(edge);
    if (high % 2 == 1) nodes_[--high].push_back(edge);
  }
}

std::size_t CheckedOutline::bandOf(double y) const {
  const double band = std::floor((y - low_) / per_band_);
  return static_cast<std::size_t>(std::clamp(band, 0.0, static_cast<double>(band_count - 1)));
}

CheckedOutline::Side CheckedOutline::at(Point p, double slack) const {
  const auto is_near = [&](std::uint32_t e) {
    const auto& [a, b] = edges_[e];
    const auto [left, right] = std::minmax(a.x, b.x);
    return left - slack <= p.x && p.x <= right + slack && distance(p, a, b) <= slack;
  };
  const std::size_t last = bandOf(p.y + slack);
  for (std::size_t band = bandOf(p.y - slack); band <= last; ++band) {
    if (anyEdgeIn(band, is_near)) return Side::edge;
  }
  bool inside = false;
  anyEdgeIn(bandOf(p.y), [&](std::uint32_t e) {
    inside = inside != crossesRay(p, edges_[e].a, edges_[e].b);
    return false;
  });
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
    const double area = sign_[e] * areaOf(part);
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
    // What of the ring lies below an edge.
    Point a = edges_[e].a - origin, b = edges_[e].b - origin;
    const double sign = a.x > b.x ? sign_[e] : -sign_[e];
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
