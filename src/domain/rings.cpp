#include "domain/rings.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/double_double.h"
#include "base/refusal.h"
#include "geometry/polygon_measures.h"
#include "geometry/predicates.h"

namespace vorpipe::core {
namespace {

constexpr double farthest_corner = 0x1p200;  ///< limit of the predicates

/// The part of the way from p to q that has a < coordinate < b, as numbers of [0, 1] along it.
struct StageRange {
  double begin = 0, end = 1;

  void keepBetween(double from, double to, double least, double most) {
    if (from == to) {
      if (from < least || from > most) end = begin;
      return;
    }
    const double first = (least - from) / (to - from), second = (most - from) / (to - from);
    begin = std::clamp(std::min(first, second), begin, end);
    end = std::clamp(std::max(first, second), begin, end);
  }
};

/// The edge's contribution to the area of the box's part to its left, down to xmin.
DoubleDouble areaBeside(Point p, Point q, const Box& box) {
  StageRange rows;
  rows.keepBetween(p.y, q.y, box.ymin, box.ymax);
  StageRange inside = rows;
  inside.keepBetween(p.x, q.x, box.xmin, box.xmax);
  const double height = q.y - p.y;
  const auto x = [&](double along) {
    return std::clamp(p.x + along * (q.x - p.x), box.xmin, box.xmax) - box.xmin;
  };
  if (inside.begin >= inside.end) {
    return DoubleDouble::product((rows.end - rows.begin) * height, x((rows.begin + rows.end) / 2));
  }
  return DoubleDouble::product((inside.begin - rows.begin) * height, x(rows.begin)) +
         DoubleDouble::product((inside.end - inside.begin) * height, (x(inside.begin) + x(inside.end)) / 2) +
         DoubleDouble::product((rows.end - inside.end) * height, x(rows.end));
}

}  // namespace

Result<Rings> ringsOf(const Outline& outline, int exponent) {
  Rings rings;
  rings.points.reserve(outline.points.size());
  rings.offsets.push_back(0);
  for (std::size_t polygon = 0; polygon + 1 < outline.polygon_offsets.size(); ++polygon) {
    for (auto r = outline.polygon_offsets[polygon]; r < outline.polygon_offsets[polygon + 1]; ++r) {
      const auto begin = rings.offsets.back();
      for (auto p = outline.ring_offsets[r]; p < outline.ring_offsets[r + 1]; ++p) {
        const Point from = outline.points[p];
        const Point point{std::ldexp(from.x, exponent), std::ldexp(from.y, exponent)};
        if (std::max(std::abs(point.x), std::abs(point.y)) > farthest_corner) {
          return tl::unexpected(refusalOf(
              Subject::outline, fmt::format("({}, {}) is too far from the domain", from.x, from.y)));
        }
        if (rings.size() == begin || rings.points.back() != point) rings.points.push_back(point);
      }
      while (rings.size() > begin + 1 && rings.points.back() == rings.points[begin]) rings.points.pop_back();
      const bool outer = r == outline.polygon_offsets[polygon];
      if (isCounterClockwise(std::span(rings.points).subspan(begin)) != outer) {
        std::reverse(rings.points.begin() + begin, rings.points.end());
      }
      rings.ring.resize(rings.size(), static_cast<std::uint32_t>(rings.offsets.size() - 1));
      rings.offsets.push_back(static_cast<std::uint32_t>(rings.size()));
      rings.outer.push_back(static_cast<std::uint32_t>(outline.polygon_offsets[polygon]));
    }
  }
  return rings;
}

bool isCounterClockwise(std::span<const Point> ring) {
  // At its leftmost point a ring turns in the direction in which it runs.
  const auto leftmost = static_cast<std::size_t>(std::ranges::min_element(ring, isLess) - ring.begin());
  const Point before = ring[leftmost > 0 ? leftmost - 1 : ring.size() - 1];
  return orientation(before, ring[leftmost], nextOf(ring, leftmost)) > 0;
}

double areaOfRing(std::span<const Point> ring) {
  double twice = 0;
  const Point origin = ring.front();
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    twice += (ring[k].x - origin.x) * (ring[k + 1].y - origin.y) -
             (ring[k + 1].x - origin.x) * (ring[k].y - origin.y);
  }
  return twice / 2;
}

bool liesIn(std::span<const Point> outer, std::span<const Point> ring) {
  for (const Point p : ring) {
    bool inside = false, touches = false;
    Point a = outer.back();
    for (const Point b : outer) {
      const int side = orientation(a, b, p);
      touches = touches || (side == 0 && isInBox(a, b, p));
      if ((a.y > p.y) != (b.y > p.y) && (side > 0) == (b.y > a.y)) inside = !inside;
      a = b;
    }
    if (!touches) return inside;
  }
  // All of its corners are on the other ring: it lies inside if it is no larger.
  return std::abs(areaOfRing(ring)) <= std::abs(areaOfRing(outer));
}

double areaInside(const Rings& rings, const Box& box) {
  DoubleDouble sum{0, 0};
  for (std::uint32_t e = 0; e < rings.size(); ++e) {
    sum = sum + areaBeside(rings.points[e], rings.endOf(e), box);
  }
  return sum.high;
}

bool isNearForRounding(Point a, Point b, Point p) {
  constexpr double steps = 8 * std::numeric_limits<double>::epsilon();
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double largest = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
  return std::abs(dx * (p.y - a.y) - dy * (p.x - a.x)) <= steps * largest * (std::abs(dx) + std::abs(dy));
}

int sideOf(Point a, Point b, Point p) {
  if (const int side = orientation(a, b, p); side != 0) return side;
  return a.y != b.y ? (b.y < a.y ? 1 : -1) : (b.x > a.x ? 1 : -1);
}

int sideOfEdge(Point p, Point q, Point a) {
  if (const int side = orientation(p, q, a); side != 0) return side;
  return p.y != q.y ? (q.y > p.y ? 1 : -1) : (q.x < p.x ? 1 : -1);
}

bool crossesRay(Point p, Point q, Point a) {
  const bool up = q.y >= a.y;
  if ((p.y >= a.y) == up) return false;
  if (p.x < a.x && q.x < a.x) return false;
  return (sideOfEdge(p, q, a) > 0) == up;
}

Rings withNodes(const Rings& rings, std::vector<EdgeNode> nodes) {
  std::ranges::sort(nodes, {}, [&](const EdgeNode& node) {
    const Point p = rings.points[node.edge], q = rings.endOf(node.edge);
    return std::pair(node.edge, placeAlong(p, q, node.at));
  });
  Rings refined;
  refined.outer = rings.outer;
  auto node = nodes.begin();
  for (std::uint32_t e = 0; e < rings.size(); ++e) {
    const auto ring = rings.ring[e];
    if (rings.offsets[ring] == e) refined.offsets.push_back(static_cast<std::uint32_t>(refined.size()));
    refined.points.push_back(rings.points[e]);
    const Point end = rings.endOf(e);
    for (; node != nodes.end() && node->edge == e; ++node) {
      if (node->at != refined.points.back() && node->at != end) refined.points.push_back(node->at);
    }
    refined.ring.resize(refined.size(), ring);
  }
  refined.offsets.push_back(static_cast<std::uint32_t>(refined.size()));
  return refined;
}

}  // namespace vorpipe::core
