/// Where cells meet: the position of a corner from the sites and walls around it.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "backend/tie.h"
#include "core/geometry/predicates.h"

namespace vorpipe::core {

/// A position as the sum of a point and what it is away from there. Kept apart, the two tell positions
/// near each other apart to the precision of their distance, wherever in the domain they lie.
struct AnchoredPoint {
  Point base, rest;
};

inline Point positionOf(const AnchoredPoint& p) { return {p.base.x + p.rest.x, p.base.y + p.rest.y}; }

inline Point relativeTo(Point origin, const AnchoredPoint& p) {
  return {(p.base.x - origin.x) + p.rest.x, (p.base.y - origin.y) + p.rest.y};
}

/// The way from a to b; from b to a it is the same with the other sign, to the bit.
inline Point wayBetween(const AnchoredPoint& a, const AnchoredPoint& b) {
  return {(b.base.x - a.base.x) + (b.rest.x - a.rest.x), (b.base.y - a.base.y) + (b.rest.y - a.rest.y)};
}

bool isVerticalWall(std::int32_t wall);

/// Its x or y.
double wallCoordinate(const Box& domain, std::int32_t wall);

/// The place of the corner of `cell` between its neighbors `before` and `after`. It follows from the
/// three sites that meet there, or two sites and a wall, and is the same to the bit for any order of
/// them; of sites that could stand for each other the lower input index goes first. Not a number where
/// the three do not meet.
AnchoredPoint cornerPosition(const SiteSet& sites, std::int32_t cell, std::int32_t before,
                             std::int32_t after);

/// Three sites, the first opposite the longest side. The order does not depend on how they are named: of
/// sites that could stand for each other the lower input index goes first.
struct Triple {
  WeightedPoint i, j, k;
};
Triple tripleOf(const SiteSet& sites, std::int32_t a, std::int32_t b, std::int32_t c);

/// The corners where the edges of `cell` to the neighbors `row` begin, ties among them or not.
void placeCorners(const SiteSet& sites, std::size_t cell, std::span<const std::int32_t> row,
                  std::vector<AnchoredPoint>& corners);

/// How much longer than a tie an edge is, times the distance between its sites, where that is no longer than
/// the domain's shorter side: (dx, dy) is the way from the cell's site to its neighbor's, (ex, ey) that from
/// the edge's beginning to its end. Turned around, for the neighbor, it is the same to the bit.
inline double excessLength(double dx, double dy, double ex, double ey) {
  return (dx * ey - dy * ex) - shortest_edge * (dx * dx + dy * dy);
}

/// The same for sites at any distance.
inline double excessLength(double dx, double dy, double ex, double ey, double shorter_side) {
  const double squared = dx * dx + dy * dy;
  if (!(squared > shorter_side * shorter_side)) return excessLength(dx, dy, ex, ey);
  return (dx * ey - dy * ex) - shortest_edge * shorter_side * std::sqrt(squared);
}

/// One edge of a cell. A wall's edge counts unless rounding might have made it: were it a tie as those
/// between sites are, it could join the ends of an edge between two sites that are near to each other.
struct EdgeSpan {
  double excess;     ///< as excessLength, or a length along a wall; a tie where it is not positive
  double tolerance;  ///< below minus this, or not a number, the edge is turned around: no tie, but wrong
  double slack;      ///< how far apart one end may be in the two cells: the shortest edge, and rounding
  bool is_coarse;    ///< rounding is longer than a tie
  [[nodiscard]] bool isTie() const { return !(excess > 0); }
  /// Whether it is a hundredth of a tie to nine ties long: where its cells differ about which sites meet at
  /// its ends, by ties that one of them does not have, it may come out as one or as none.
  [[nodiscard]] bool isAboutATie() const { return excess > -0.99 * tolerance && excess < 8 * tolerance; }
  [[nodiscard]] bool isTurned() const { return !(excess >= -tolerance); }
};

/// The edge of `cell` to `neighbor`, a site or a wall, which runs from `begin`, where the neighbor before
/// ends, to `end`, where the one after begins.
/// `shortest` is the part of the sites' distance, or of the domain's shorter side, that is a tie:
/// shortest_edge, or less where ties in a row would make a vertex wide (wide_vertices.h).
EdgeSpan edgeSpan(const SiteSet& sites, std::int32_t cell, std::int32_t before, std::int32_t neighbor,
                  std::int32_t after, const AnchoredPoint& begin, const AnchoredPoint& end,
                  double shortest = shortest_edge);

}  // namespace vorpipe::core
