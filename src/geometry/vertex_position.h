/// Where cells meet: computes the position of a corner from the sites and walls around it.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "backend/site_set.h"
#include "backend/tie.h"
#include "geometry/predicates.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// A position as the unevaluated sum of an anchor, usually a site, and the vector from there. The difference
/// of two nearby positions is then rounded relative to their distance, not to their coordinates.
struct AnchoredPoint {
  Point base, rest;
};

inline Point positionOf(const AnchoredPoint& p) { return {p.base.x + p.rest.x, p.base.y + p.rest.y}; }

inline Point relativeTo(Point origin, const AnchoredPoint& p) {
  return {(p.base.x - origin.x) + p.rest.x, (p.base.y - origin.y) + p.rest.y};
}

/// The vector from a to b. wayBetween(b, a) is its exact negative.
inline Point wayBetween(const AnchoredPoint& a, const AnchoredPoint& b) {
  return {(b.base.x - a.base.x) + (b.rest.x - a.rest.x), (b.base.y - a.base.y) + (b.rest.y - a.rest.y)};
}

bool isVerticalWall(std::int32_t wall);

/// Returns the direction out of the domain along the wall's axis: 1 or -1.
inline int outward(std::int32_t wall) { return wall == wall_xmax || wall == wall_ymax ? 1 : -1; }

/// The x of a vertical wall, the y of a horizontal one.
double wallCoordinate(const Box& domain, std::int32_t wall);

/// The position of the corner of `cell` between its neighbors `before` and `after`. It depends on the three
/// sites, or two sites and a wall, that meet there, and is the same to the bit for any order of them: among
/// interchangeable sites the lower input index goes first. NaN if the three do not meet, e.g. two parallel
/// walls.
AnchoredPoint cornerPosition(const SiteSet& sites, std::int32_t cell, std::int32_t before,
                             std::int32_t after);

/// Three sites, the first opposite the longest side. Independent of the order in which they are given: among
/// interchangeable sites the lower input index goes first.
struct Triple {
  WeightedPoint i, j, k;
};
Triple tripleOf(const SiteSet& sites, std::int32_t a, std::int32_t b, std::int32_t c);

/// Stores in `corners` where the edges of `cell` to the neighbors `row` begin, ties included.
void placeCorners(const SiteSet& sites, std::size_t cell, std::span<const std::int32_t> row,
                  std::vector<AnchoredPoint>& corners);

/// (Length of an edge - longest tie) * distance of its sites, if that distance is at most the domain's
/// shorter side. (dx, dy): from the cell's site to its neighbor's; (ex, ey): from the edge's beginning to its
/// end. Seen from the neighbor, both vectors are negated and the result is the same to the bit.
inline double excessLength(double dx, double dy, double ex, double ey) {
  return (dx * ey - dy * ex) - shortest_edge * (dx * dx + dy * dy);
}

/// The same for sites at any distance.
inline double excessLength(double dx, double dy, double ex, double ey, double shorter_side) {
  const double squared = dx * dx + dy * dy;
  if (!(squared > shorter_side * shorter_side)) return excessLength(dx, dy, ex, ey);
  return (dx * ey - dy * ex) - shortest_edge * shorter_side * std::sqrt(squared);
}

/// One edge of a cell. An edge at a wall is a tie only if rounding is longer. A threshold relative to a
/// distance, as between sites, could join the ends of an edge between two nearby sites.
struct EdgeSpan {
  double excess;     ///< as excessLength, or a length along a wall; a tie if it is not positive
  double tolerance;  ///< if `excess` is below minus this, or NaN, the edge is turned around: not a tie, but
                     ///< wrong
  double slack;      ///< how far apart one end may be in the two cells: the shortest edge, and rounding
  bool is_coarse;    ///< rounding is longer than a tie
  [[nodiscard]] bool isTie() const { return !(excess > 0); }
  /// Whether it is from 0.01 to 9 ties long. If its two cells differ about the sites at its ends, because one
  /// lacks ties that the other has, such an edge may or may not come out as a tie.
  [[nodiscard]] bool isAboutATie() const { return excess > -0.99 * tolerance && excess < 8 * tolerance; }
  [[nodiscard]] bool isTurned() const { return !(excess >= -tolerance); }
};

/// Whether an edge between sites, with arguments as in excessLength, is so long that its span is neither
/// about a tie nor turned: above sixteen times the longest tie plus the most rounding.
inline bool isFarFromATie(double dx, double dy, double ex, double ey) {
  constexpr double times = 16, most_rounding = 0x1p-40;
  const double squared = dx * dx + dy * dy;
  return dx * ey - dy * ex > times * (shortest_edge * squared + most_rounding * std::sqrt(squared));
}

/// The edge of `cell` to `neighbor`, a site or a wall, from `begin`, where the edge to `before` ends, to
/// `end`, where the edge to `after` begins. `shortest` is the longest tie relative to the sites' distance, or
/// to the domain's shorter side: shortest_edge, or less where ties in a row would make a vertex wide
/// (cells/wide_vertices.cpp).
EdgeSpan edgeSpan(const SiteSet& sites, std::int32_t cell, std::int32_t before, std::int32_t neighbor,
                  std::int32_t after, const AnchoredPoint& begin, const AnchoredPoint& end,
                  double shortest = shortest_edge);

}  // namespace vorpipe::core
