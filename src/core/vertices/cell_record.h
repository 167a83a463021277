/// The records of cells: from the sites of a SiteSet, in scaled units, to input order and the caller's units.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "base/inside.h"
#include "core/geometry/polygon_measures.h"
#include "core/geometry/vertex_position.h"

namespace vorpipe::core {

/// From scaled units to the caller's, by a power of two: nothing is rounded.
class Unscale {
 public:
  explicit Unscale(int exponent) : exponent_(exponent), plain_(std::abs(exponent) < 200) {
    if (!plain_) return;
    for (int power = 1; power <= 4; ++power) factor_[power] = std::ldexp(1.0, -power * exponent);
  }
  [[nodiscard]] double operator()(double value, int power = 1) const {
    return plain_ ? value * factor_[power] : std::ldexp(value, -power * exponent_);
  }
  [[nodiscard]] Point operator()(Point p) const { return {(*this)(p.x), (*this)(p.y)}; }

 private:
  int exponent_;
  bool plain_;
  double factor_[5] = {1, 1, 1, 1, 1};
};

/// A neighbor as a Diagram has it: a wall, or an index in the input.
inline std::int64_t outsideIndex(const SiteSet& sites, std::int32_t neighbor) {
  return neighbor < 0 ? std::int64_t{neighbor} : std::int64_t{sites.id[static_cast<std::size_t>(neighbor)]};
}

/// What a cell is measured about: its site; or its first corner where it may be small and far from its site,
/// with weights and of sites outside the domain.
inline Point measuringOrigin(const SiteSet& sites, std::size_t cell, const AnchoredPoint& first_corner) {
  const Point site{sites.x[cell], sites.y[cell]};
  const bool holds_site = sites.weight.empty() && isInside(sites.domain, site.x, site.y);
  return holds_site ? site : positionOf(first_corner);
}

/// Measures the cell with these corners, counter-clockwise, about `origin`.
inline Measures measureCell(Point origin, std::span<const AnchoredPoint> corners) {
  thread_local std::vector<Point> polygon;
  polygon.clear();
  for (const auto& corner : corners) polygon.push_back(relativeTo(origin, corner));
  return measurePolygon(polygon);
}

/// What a Diagram says of one site. Input order is anywhere in memory, so that it is written to one place and
/// not yet to the arrays of a Diagram, which are four.
struct CellRecord {
  double area;
  Point centroid;
  std::uint32_t edges;
  Status status;
};

/// Writes the records of cells; any thread may write any cell.
struct Records {
  const SiteSet& sites;
  Unscale unscale;
  std::span<CellRecord> by_input;

  /// Says that the record of `cell` will be written soon: a store that waits for its memory holds up those
  /// behind it.
  void prefetch(std::size_t cell) const {
#if defined(__GNUC__)
    __builtin_prefetch(&by_input[sites.id[cell]], 1);
#else
    (void)cell;
#endif
  }
  void empty(std::size_t cell) const {
    by_input[sites.id[cell]] = {0, unscale(Point{sites.x[cell], sites.y[cell]}), 0, Status::empty};
  }
  /// `centroid` is relative to `origin`, as measuringOrigin has it.
  void cell(std::size_t cell, std::size_t edges, double area, Point origin, Point centroid) const {
    by_input[sites.id[cell]] = {unscale(area, 2),
                                unscale(Point{origin.x + centroid.x, origin.y + centroid.y}),
                                static_cast<std::uint32_t>(edges), Status::ok};
  }
};

}  // namespace vorpipe::core
