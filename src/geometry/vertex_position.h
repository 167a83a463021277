/// Where cells meet: the position of a corner from the sites and walls around it.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "backend/tie.h"
#include "geometry/anchored_point.h"
#include "geometry/predicates.h"

namespace vorpipe::core {

bool isVerticalWall(std::int32_t wall);

/// The x of a vertical wall, the y of a horizontal one.
double wallCoordinate(const Box& domain, std::int32_t wall);

/// The position of the corner of `cell` between its neighbors `before` and `after`. It depends on the three
/// sites, or two sites and a wall, that meet there, and is the same to the bit for any order of them: among
/// interchangeable sites the lower input index goes first. NaN where the three do not meet, as two
/// parallel walls do not.
AnchoredPoint cornerPosition(const SiteSet& sites, std::int32_t cell, std::int32_t before,
                             std::int32_t after);

/// Three sites, the first opposite the longest side. Independent of the order in which they are given: among
/// interchangeable sites the lower input index goes first.
struct Triple {
  WeightedPoint i, j, k;
};
Triple tripleOf(const SiteSet& sites, std::int32_t a, std::int32_t b, std::int32_t c);

/// The corners where the edges of `cell` to the neighbors `row` begin, ties among them or not.
void placeCorners(const SiteSet& sites, std::size_t cell, std::span<const std::int32_t> row,
                  std::vector<AnchoredPoint>& corners);

/// (Length of an edge - longest tie) * distance of its sites, where that distance is at most the domain's
/// shorter side. (dx, dy): from the cell's site to its neighbor's; (ex, ey): from the edge's beginning to its
/// end. Seen from the neighbor, where both are negated, it is the same to the bit.
inline double excessLength(double dx, double dy, double ex, double ey) {
  return (dx * ey - dy * ex) - shortest_edge * (dx * dx + dy * dy);
}

/// The same for sites at any distance.
inline double excessLength(double dx, double dy, double ex, double ey, double shorter_side) {
  const double squared = dx * dx + dy * dy;
  if (!(squared > shorter_side * shorter_side)) return excessLength(dx, dy, ex, ey);
  return (dx * ey - dy * ex) - shortest_edge * shorter_side * std::sqrt(squared);
}

/// One edge of a cell. An edge at a wall is a tie only where rounding is longer: were it one below a part of
/// a distance, as between sites, it could join the ends of an edge between two sites near each other.
struct EdgeSpan {
  double excess;     ///< as excessLength, or a length along a wall; a tie where it is not positive
  double tolerance;  ///< below minus this, or not a number, the edge is turned around: no tie, but wrong
  double slack;      ///< how far apart one end may be in the two cells: the shortest edge, and rounding
  bool is_coarse;    ///< rounding is longer than a tie
  [[nodiscard]] bool isTie() const { return !(excess > 0); }
  /// Whether it is from 0.01 to 9 ties long. Where its two cells differ about the sites at its ends, since
  /// one lacks ties that the other has, such an edge may come out as a tie or not.
  [[nodiscard]] bool isAboutATie() const { return excess > -0.99 * tolerance && excess < 8 * tolerance; }
  [[nodiscard]] bool isTurned() const { return !(excess >= -tolerance); }
};

/// Whether an edge between sites, seen as in excessLength, is so long that its span is neither about a tie
/// nor turned: sixteen times the longest tie and the most that rounding is.
inline bool isFarFromATie(double dx, double dy, double ex, double ey) {
  constexpr double times = 16, most_rounding = 0x1p-40;
  const double squared = dx * dx + dy * dy;
  return dx * ey - dy * ex > times * (shortest_edge * squared + most_rounding * std::sqrt(squared));
}

/// The edge of `cell` to `neighbor`, a site or a wall, which runs from `begin`, where the neighbor before
/// ends, to `end`, where the one after begins.
/// `shortest` is the part of the sites' distance, or of the domain's shorter side, that is a tie:
/// shortest_edge, or less where ties in a row would make a vertex wide (wide_vertices.h).
EdgeSpan edgeSpan(const SiteSet& sites, std::int32_t cell, std::int32_t before, std::int32_t neighbor,
                  std::int32_t after, const AnchoredPoint& begin, const AnchoredPoint& end,
                  double shortest = shortest_edge);

}  // namespace vorpipe::core
