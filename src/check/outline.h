/// What is checked where the domain has an outline.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "check/box_tree.h"
#include "check/checks.h"

namespace vorpipe::core::checks {

/// An outline in scaled coordinates, which shares nothing with what clips cells.
class CheckedOutline {
 public:
  explicit CheckedOutline(const CheckedSites& run);

  /// A side of a ring, which has the inside to its left.
  struct Edge {
    Point a, b;
  };
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  /// Calls take(k) for each edge k that may come as near to p as `slack`.
  template <class Take>
  void eachNear(Point p, double slack, const Take& take) const {
    eachMeeting(grown(boxAround(p, p), slack), take);
  }
  /// The same for the box of each.
  template <class Take>
  void eachMeeting(const Box& box, const Take& take) const {
    tree_->eachMeeting(box, take);
  }

  enum class Side : std::uint8_t { inside, outside, edge };
  /// Where p lies; `edge` if no farther than `slack` from one.
  [[nodiscard]] Side at(Point p, double slack) const;

  /// The area inside both the outline and the domain, in the caller's units.
  [[nodiscard]] double area() const;
  /// The area inside both the outline and a convex ring, scaled, whose points are seen from `origin`.
  [[nodiscard]] double area(std::span<const Point> ring, Point origin) const;
  /// Of all edges, scaled.
  [[nodiscard]] double length() const;

 private:
  const CheckedSites& run_;
  std::vector<Edge> edges_;
  std::optional<BoxTree> tree_;  ///< of the edges
};

/// What is wrong with the area of cell i, beside what the bisectors with all sites leave of the domain, and
/// of the outline if there is one. The domain does not repeat. Takes a step for each site.
std::string wrongArea(const CheckedCells& run, const CheckedOutline* outline, std::size_t i);

/// The same of some cells: of the thinnest, whose polygons ties change most. None where the domain repeats.
void checkThinAreas(const CheckedCells& run, const CheckedOutline* outline, Broken& broken);

/// What is wrong with the rings of cell i as polygons: each runs without crossing or touching itself, the
/// outer ones counter-clockwise and apart from each other but for points, each followed by its holes, which
/// run clockwise inside of it and leave its inside in one piece. All of it exactly, of the vertices as they
/// are written; but what rounding and ties may have brought together may touch, unless the sites and the
/// outline say that it is one place.
std::string wrongShape(const CheckedCells& run, const CheckedOutline& outline, std::size_t i);

/// Whether a place p lies in a side or corner of the outline, but for rounding, that lies in the bisector of
/// two sites exactly.
bool isWhereSideIsBisector(const CheckedCells& run, const CheckedOutline& outline, std::size_t i,
                           std::size_t j, Point p);

/// Edges along the outline and along walls: each lies on a side, and all sides of the inside are covered
/// once; what two cells share does not lie in a side, however the bisector runs.
void checkBorder(const CheckedCells& run, const CheckedOutline& outline, Broken& broken);

/// The promises about cells that are clipped to an outline: rings and their measures; edges on the bisector
/// and in the neighbor's list, from the same point to the same, or on the outline; vertices of cells are
/// nearest to their sites; pseudo-random places of the inside lie in the cell of their nearest site, others
/// in none.
///
/// That is a proof (decision D125). What two cells share cancels, and what is left of all rings is the
/// outline, once: so the cells lie side by side and fill it. No site is nearer to a vertex of a cell than its
/// own, so none is to any place inside; so cells are what they should be, and their common edges are, too.
void checkClipped(const CheckedCells& run, const CheckedOutline& outline, const NearestSite& nearest,
                  Broken& broken);

}  // namespace vorpipe::core::checks
