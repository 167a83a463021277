/// What is checked where the domain has an outline.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/check/checks.h"

namespace vorpipe::core::checks {

/// An outline in scaled coordinates, which shares nothing with what clips cells.
class CheckedOutline {
 public:
  explicit CheckedOutline(const CheckedSites& run);

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
  struct Edge {
    Point a, b;
  };
  static constexpr std::size_t band_count = 4096;

  [[nodiscard]] std::size_t bandOf(double y) const;
  void addToBands(std::uint32_t edge, std::size_t first, std::size_t last);
  /// Whether `test` is true of an edge of this band; no other is tested after that.
  template <class Test>
  bool anyEdgeIn(std::size_t band, const Test& test) const {
    for (std::size_t node = band + band_count; node > 0; node /= 2) {
      if (std::ranges::any_of(nodes_[node], test)) return true;
    }
    return false;
  }

  const CheckedSites& run_;
  std::vector<Edge> edges_;
  std::vector<int> sign_;  ///< of each edge: 1 where the inside lies to its left
  double low_ = 0, per_band_ = 1;
  /// Edges by bands of y, as a segment tree: node 1 has all bands, 2n and 2n + 1 the halves of n. An edge
  /// stands in few nodes that have its bands, so that long edges take no more memory than some short ones.
  std::vector<std::vector<std::uint32_t>> nodes_;
};

/// What is wrong with the area of cell i, beside what the bisectors with all sites leave of the domain, and
/// of the outline if there is one. The domain does not repeat. Takes a step for each site.
std::string wrongArea(const CheckedCells& run, const CheckedOutline* outline, std::size_t i);

/// The same of some cells: of the thinnest, whose polygons ties change most. None where the domain repeats.
void checkThinAreas(const CheckedCells& run, const CheckedOutline* outline, Broken& broken);

/// The promises about cells that are clipped to an outline: rings and their measures; edges on the bisector
/// and in the neighbor's list, from the same point to the same, or on the outline; pseudo-random places of
/// the inside lie in the cell of their nearest site, others in none.
void checkClipped(const CheckedCells& run, const CheckedOutline& outline, const NearestSite& nearest,
                  Broken& broken);

}  // namespace vorpipe::core::checks
