/// An outline prepared for clipping.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// Lexicographic order: by x, then by y.
inline bool isLess(Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

/// How far p is along the segment from a to b, times the segment's length.
inline double alongWay(Point a, Point b, Point p) {
  return (p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y);
}

/// A key that ascends along the segment from a to b, for rounded points on it. It consists of their own
/// coordinates, which distinguish them as far as doubles can. From b to a it descends.
inline std::array<double, 2> placeAlong(Point a, Point b, Point p) {
  const double x = b.x < a.x ? -p.x : p.x, y = b.y < a.y ? -p.y : p.y;
  return std::abs(b.x - a.x) >= std::abs(b.y - a.y) ? std::array{x, y} : std::array{y, x};
}

inline Box boxAround(Point a, Point b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)};
}

/// Whether p lies in the box of a and b, its border included.
inline bool isInBox(Point a, Point b, Point p) {
  const Box box = boxAround(a, b);
  return p.x >= box.xmin && p.x <= box.xmax && p.y >= box.ymin && p.y <= box.ymax;
}

inline bool areApart(const Box& a, const Box& b) {
  return a.xmax < b.xmin || b.xmax < a.xmin || a.ymax < b.ymin || b.ymax < a.ymin;
}

/// Whether a point on or near the line through a and b lies strictly between them.
inline bool isBetween(Point a, Point b, Point p) {
  return p != a && p != b && alongWay(a, b, p) > 0 && alongWay(b, a, p) > 0;
}

/// Whether p is so close to the line through a and b that rounding of a and b may have changed the side on
/// which it lies.
bool isNearForRounding(Point a, Point b, Point p);

/// Closed rings, outer ones counter-clockwise and holes clockwise, so that the inside lies to the left of
/// every edge; no two neighboring points are equal. Edge e runs from point e to point next(e).
struct Rings {
  std::vector<Point> points;
  std::vector<std::uint32_t> offsets;  ///< of each ring, and one more: the number of points
  std::vector<std::uint32_t> ring;     ///< of each point
  std::vector<std::uint32_t> outer;    ///< of each ring: the outer ring of its polygon

  [[nodiscard]] std::size_t size() const { return points.size(); }
  [[nodiscard]] std::uint32_t next(std::uint32_t e) const {
    return e + 1 < offsets[ring[e] + std::size_t{1}] ? e + 1 : offsets[ring[e]];
  }
  [[nodiscard]] Point endOf(std::uint32_t e) const { return points[next(e)]; }
  [[nodiscard]] bool isOuter(std::uint32_t r) const { return outer[r] == r; }
};

/// Accepts only an empty outline or valid polygons. Refuses: inconsistent offsets; numbers that are not
/// finite; rings of fewer than 3 points or without area; rings that cross themselves or each other; polygons
/// that overlap or share a side; more than 2^31 points; a box with an area beyond the range of double; and a
/// domain that is also periodic. Error (input): names the ring, or the place in the outline's own
/// coordinates.
Result<void> checkOutline(const Outline& outline, Periodic periodic);

/// A ring of an outline.
inline std::span<const Point> ringAt(const Outline& outline, std::size_t ring) {
  const auto begin = outline.ring_offsets[ring], end = outline.ring_offsets[ring + 1];
  return std::span(outline.points).subspan(begin, end - begin);
}

/// The rings of a valid outline, scaled by 2^exponent. Error (input): they are too far from the domain, which
/// this scale makes about 1 in size.
Result<Rings> ringsOf(const Outline& outline, int exponent);

/// For a ring without equal neighboring points that does not cross itself.
bool isCounterClockwise(std::span<const Point> ring);

/// The signed area that a ring winds around; without rounding errors from coordinates far from 0.
double areaOfRing(std::span<const Point> ring);

/// Whether a ring of at least 3 points lies in another, which it does not cross; they may touch in points.
bool liesIn(std::span<const Point> outer, std::span<const Point> ring);

/// The area of the intersection of the rings' inside and the box.
double areaInside(const Rings& rings, const Box& box);

/// Exact predicates between a ring and other points: all rings are perturbed by (e, e^2) for an infinitesimal
/// e > 0 (Edelsbrunner and Mucke 1990, "Simulation of simplicity"). So no vertex of a ring lies on a line
/// through other points, no other point lies on an edge of a ring, and no predicate returns 0.
///
/// p is a vertex of a ring; a and b are not, and differ. 1: p lies to the left of the line from a to b; -1:
/// to the right.
int sideOf(Point a, Point b, Point p);

/// p to q is an edge of a ring; a is no vertex of one. 1: a lies to the left of the edge; -1: to the right.
int sideOfEdge(Point p, Point q, Point a);

/// p to q is an edge of a ring; a is no vertex of one. Whether the edge crosses the ray from a to the right.
bool crossesRay(Point p, Point q, Point a);

/// A point to insert into an edge.
struct EdgeNode {
  std::uint32_t edge;
  Point at;
};

/// The rings with these points in their edges, each once; a point at an end of its edge is already there.
Rings withNodes(const Rings& rings, std::vector<EdgeNode> nodes);

}  // namespace vorpipe::core
