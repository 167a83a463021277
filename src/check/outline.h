/// Checks for a domain with an outline.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "check/checks.h"
#include "check/places.h"
#include "check/run.h"

namespace vorpipe::core::checks {

/// The rings of one cell of a diagram whose domain has an outline.
class CellRings {
 public:
  CellRings(const CheckedCells& run, std::size_t i) : run_(run), end_(run.end(i)) {
    const auto& starts = run.diagram.ring_starts;
    for (auto s = std::ranges::lower_bound(starts, run.begin(i)); s != starts.end() && *s < end_; ++s) {
      starts_.push_back(*s);
    }
  }
  [[nodiscard]] std::size_t size() const { return starts_.size(); }
  [[nodiscard]] std::size_t begin(std::size_t r) const { return starts_[r]; }
  [[nodiscard]] std::size_t end(std::size_t r) const { return r + 1 < size() ? starts_[r + 1] : end_; }
  [[nodiscard]] std::size_t next(std::size_t r, std::size_t e) const {
    return e + 1 < end(r) ? e + 1 : begin(r);
  }

  /// Calls take(edge, from, to) for each edge.
  template <class Take>
  void eachEdge(const Take& take) const {
    for (std::size_t r = 0; r < size(); ++r) {
      for (std::size_t e = begin(r); e < end(r); ++e) take(e, run_.vertex(e), run_.vertex(next(r, e)));
    }
  }

 private:
  const CheckedCells& run_;
  std::size_t end_;
  std::vector<std::size_t> starts_;
};

/// An outline in scaled coordinates, which shares no code with clipping.
class CheckedOutline {
 public:
  explicit CheckedOutline(const CheckedSites& run);

  /// A side of a ring, which has the inside to its left.
  struct Edge {
    Point a, b;
  };
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  /// Calls take(k) for each edge k that may come within `slack` of p.
  template <class Take>
  void eachNear(Point p, double slack, const Take& take) const {
    eachMeeting(grown(boxAround(p, p), slack), take);
  }
  /// Calls take(k) for each edge k whose box meets `box`.
  template <class Take>
  void eachMeeting(const Box& box, const Take& take) const {
    tree_->eachMeeting(box, take);
  }

  enum class Side : std::uint8_t { inside, outside, edge };
  /// The location of p; `edge` if it is within `slack` of an edge.
  [[nodiscard]] Side at(Point p, double slack) const;

  /// The area inside both the outline and the domain, in the caller's units.
  [[nodiscard]] double area() const;
  /// The area inside both the outline and a convex ring, scaled; its points are relative to `origin`.
  [[nodiscard]] double area(std::span<const Point> ring, Point origin) const;
  /// The length of all edges, scaled.
  [[nodiscard]] double length() const;

 private:
  const CheckedSites& run_;
  std::vector<Edge> edges_;
  std::optional<BoxTree> tree_;  ///< of the edges
};

/// What is wrong with the area of cell i, compared with the part of the domain, and of the outline if any,
/// that the bisectors with all sites leave. The domain does not repeat. Takes one step for each site.
std::string wrongArea(const CheckedCells& run, const CheckedOutline* outline, std::size_t i);

/// Checks the same for the thinnest cells, whose polygons ties change most. Does nothing if the domain
/// repeats.
void checkThinAreas(const CheckedCells& run, const CheckedOutline* outline, Broken& broken);

/// What is wrong with the rings of cell i as polygons. Each ring must not cross or touch itself. Outer ones
/// are counter-clockwise, and apart from each other except for points. Each is followed by its holes, which
/// run clockwise inside of it and leave its inside in one piece. The test is exact, on the vertices as
/// written. Edges that rounding and ties may have brought together may touch, unless the sites and the
/// outline show that they meet in one place.
std::string wrongShape(const CheckedCells& run, const CheckedOutline& outline, std::size_t i);

/// Whether p lies, up to rounding, on a side or corner of the outline that lies exactly on the bisector of
/// two sites.
bool isWhereSideIsBisector(const CheckedCells& run, const CheckedOutline& outline, std::size_t i,
                           std::size_t j, Point p);

/// Checks edges along the outline and along walls: each lies on a side, and all sides of the inside are
/// covered once. The common edge of two cells does not lie on a side, whatever the bisector.
void checkBorder(const CheckedCells& run, const CheckedOutline& outline, Broken& broken);

/// Checks the promises about cells that are clipped to an outline: rings and their measures; edges that lie
/// on the bisector and in the neighbor's list, with the same ends, or on the outline; vertices of cells that
/// are nearest to their sites; pseudo-random places, which lie in the cell of their nearest site if inside,
/// else in none.
///
/// That is a proof (decision D125). Common edges of two cells cancel, and the rest of all rings is the
/// outline, once: so the cells lie side by side and fill it. No site is nearer to a vertex of a cell than its
/// own, hence none is nearer to any place inside. So the cells are correct, and so are their common edges.
void checkClipped(const CheckedCells& run, const CheckedOutline& outline, const NearestSite& nearest,
                  Broken& broken);

}  // namespace vorpipe::core::checks
