/// An outline made ready for clipping.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// An order of points, by x and then by y.
inline bool isLess(Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

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
  [[nodiscard]] bool isOuter(std::uint32_t r) const { return outer[r] == r; }
};

/// Refuses what is not empty and no valid polygon or polygons: offsets that do not fit, numbers that are not
/// finite, rings of fewer than 3 points or without area, rings that cross themselves or each other, polygons
/// that overlap or share a side, more than 2^31 points, a box with an area beyond the range of double, a
/// domain that is periodic besides. Error (input): names the ring, or the place in the outline's own
/// coordinates.
Result<void> checkOutline(const Outline& outline, Periodic periodic);

/// The rings of a valid outline, scaled by 2^exponent. Error (input): they are too far from the domain, which
/// that scales to about 1.
Result<Rings> ringsOf(const Outline& outline, int exponent);

/// The area of the rings' inside that lies in the box.
double areaInside(const Rings& rings, const Box& box);

/// Points and edges of rings are compared with others as if all rings lay shifted by (e, e^2), e smaller than
/// any number but more than 0 (Edelsbrunner and Mucke 1990, "Simulation of simplicity"): no point of a ring
/// then lies on a line through other points, nor any other point on an edge of a ring.
///
/// Positive if p, of a ring, lies to the left of the way from a to b, two different points of none; else
/// negative.
int sideOf(Point a, Point b, Point p);

/// The same for a point of none, and the edge from p to q of a ring.
int sideOfEdge(Point p, Point q, Point a);

/// Whether the edge from p to q of a ring crosses the ray from a, a point of none, to the right.
bool crossesRay(Point p, Point q, Point a);

}  // namespace vorpipe::core
