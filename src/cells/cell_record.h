/// Records of cells: from SiteSet order and scaled units to input order and the caller's units.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "base/inside.h"
#include "geometry/polygon_measures.h"
#include "geometry/vertex_position.h"

namespace vorpipe::core {

/// Converts scaled units to the caller's. The factor is a power of two, so the conversion is exact.
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

/// A neighbor as in Diagram::neighbors: a wall, or an index in the input.
inline std::int64_t outsideIndex(const SiteSet& sites, std::int32_t neighbor) {
  return neighbor < 0 ? std::int64_t{neighbor} : std::int64_t{sites.id[static_cast<std::size_t>(neighbor)]};
}

/// The origin for measuring a cell: its site, or its first corner if the cell may be small and far from the
/// site. That can happen with weights and for sites outside the domain.
inline Point measuringOrigin(const SiteSet& sites, std::size_t cell, const AnchoredPoint& first_corner) {
  const Point site{sites.x[cell], sites.y[cell]};
  const bool holds_site = sites.weight.empty() && isInside(sites.domain, site.x, site.y);
  return holds_site ? site : positionOf(first_corner);
}

/// Measures the cell with these corners, counter-clockwise, about `origin`.
inline Measures measureCell(Point origin, std::span<const AnchoredPoint> corners) {
  constexpr std::size_t usual_corners = 32;
  std::array<Point, usual_corners> few;
  std::vector<Point> many(corners.size() > usual_corners ? corners.size() : 0);
  const auto polygon = many.empty() ? std::span(few).first(corners.size()) : std::span(many);
  std::ranges::transform(corners, polygon.begin(),
                         [&](const AnchoredPoint& corner) { return relativeTo(origin, corner); });
  return measurePolygon(polygon);
}

/// The per-site results of a Diagram. Input order is random access here: one record means one cache miss,
/// where the four arrays of a Diagram would mean four.
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
  std::span<double> spread{};  ///< by input index, as CellMoments::spread; empty if not wanted

  /// Prefetches the record of `cell` for writing: stores retire in order, so a miss would stall later ones.
  void prefetch(std::size_t cell) const {
#if defined(__GNUC__)
    __builtin_prefetch(&by_input[sites.id[cell]], 1);
#else
    (void)cell;
#endif
  }
  void empty(std::size_t cell) const {
    by_input[sites.id[cell]] = {0, unscale(Point{sites.x[cell], sites.y[cell]}), 0, Status::empty};
    if (!spread.empty()) spread[sites.id[cell]] = 0;
  }
  /// Replaces the number of edges of a recorded cell.
  void setEdges(std::size_t cell, std::size_t edges) const {
    by_input[sites.id[cell]].edges = static_cast<std::uint32_t>(edges);
  }
  /// `centroid` is relative to `origin`, which is as in measuringOrigin. `about_centroid` is the integral of
  /// the squared distance to the centroid; it is ignored if spread is not wanted.
  void cell(std::size_t cell, std::size_t edges, double area, Point origin, Point centroid,
            double about_centroid) const {
    if (!spread.empty()) spread[sites.id[cell]] = unscale(about_centroid, 4);
    by_input[sites.id[cell]] = {unscale(area, 2),
                                unscale(Point{origin.x + centroid.x, origin.y + centroid.y}),
                                static_cast<std::uint32_t>(edges), Status::ok};
  }
};

}  // namespace vorpipe::core
