#include "cells/tied_vertices.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "geometry/polygon_measures.h"

namespace vorpipe::core {
namespace {

/// A vertex with fewer ties is not wide. A tie counts twice, even if one of its two cells lacks it: which
/// cells have an edge of almost zero length depends on the backend.
constexpr std::uint32_t fewest_ties = 6, fewest_with_images = 4;
/// How far vertices may be from a cell's corners, relative to the corner's distance from its site, or to the
/// domain's shorter side if that is less. `--check` allows 1.25 times that. With weights, distances are
/// relative to the cell's reach: more cells nearly meet in a point, and ties with far sites are long.
constexpr double wide = 8e-6, wide_with_weights = 8e-5, nearly = 0.5;
/// In a periodic domain a vertex may have four copies, and in each, ties may join different corners. The
/// copies become one (domain/seam.cpp), up to seven times as far from a corner as each copy alone.
constexpr double part_with_images = 0.125;

class VertexWidths {
 public:
  VertexWidths(const ProposedCells& proposed, const TiedCells& tied, const Fineness& fineness)
      : proposed_(proposed),
        sites_(proposed.sites),
        tied_(tied),
        fineness_(fineness),
        fewest_(sites_.has_images ? fewest_with_images : fewest_ties),
        ties_(tied.position.size()) {}

  WideVertices run() {
    forTiedCells(tied_, proposed_.threads, [&](std::size_t k) {
      const auto cell = tied_.cell[k];
      const auto row = proposed_.cells.edges(cell);
      for (std::size_t e = 0; e < row.size(); ++e) {
        const auto c = tied_.offsets[k] + e;
        if (tied_.tie[c] == 0) continue;
        const std::uint32_t ties = isOfThisCellAlone(cell, row[e]) ? 2 : 1;
        std::atomic_ref(ties_[tied_.vertex[c]]).fetch_add(ties, std::memory_order_relaxed);
      }
    });
    if (std::ranges::none_of(ties_, [&](std::uint32_t ties) { return ties >= fewest_; })) return {};
    width_.assign(ties_.size(), 0);
    std::vector<AnchoredPoint> corners;
    for (std::size_t k = 0; k < tied_.cell.size(); ++k) measure(k, corners);
    const double most =
        (sites_.weight.empty() ? wide : wide_with_weights) * (sites_.has_images ? part_with_images : 1);
    return {cellsAt(nearly * most), cellsAt(most)};
  }

 private:
  [[nodiscard]] bool isOfThisCellAlone(std::uint32_t cell, std::int32_t neighbor) const {
    if (neighbor < 0) return false;
    const auto other = static_cast<std::size_t>(neighbor);
    const auto back =
        proposed_.index.find(proposed_.cells.edges(other), other, static_cast<std::int32_t>(cell));
    return back == EdgeIndex::none;
  }

  [[nodiscard]] bool hasMany(std::uint64_t corner) const { return ties_[tied_.vertex[corner]] >= fewest_; }

  void measure(std::size_t k, std::vector<AnchoredPoint>& corners) {
    const auto first = tied_.offsets[k], count = tied_.offsets[k + 1] - first;
    bool any = false;
    for (std::uint64_t e = 0; e < count && !any; ++e) any = hasMany(first + e);
    if (!any) return;
    const auto cell = tied_.cell[k];
    const auto row = proposed_.cells.edges(cell);
    // With weights, the cell's reach needs all corners.
    if (!sites_.weight.empty()) placeCorners(sites_, cell, row, corners);
    const Point site{sites_.x[cell], sites_.y[cell]};
    const double most = shorterSide(sites_), rounding = roundingAt(site);
    const double reach = sites_.weight.empty() ? 0 : reachOf(cell, row, corners);
    for (std::size_t e = 0; e < row.size(); ++e) {
      if (!hasMany(first + e)) continue;
      const auto vertex = tied_.vertex[first + e];
      const AnchoredPoint corner =
          cornerPosition(sites_, static_cast<std::int32_t>(cell), row[edgeBefore(row, e)], row[e]);
      const double off = lengthOf(wayBetween(tied_.position[vertex], corner)) - rounding;
      const double whole = std::min(std::max(reach, lengthOf(relativeTo(site, corner))), most);
      if (off > 0) width_[vertex] = std::max(width_[vertex], off / whole);
    }
  }

  /// How far rounding may move a point in the domain or at a site.
  [[nodiscard]] double roundingAt(Point site) const {
    constexpr double steps = 16 * std::numeric_limits<double>::epsilon();
    const Box& domain = sites_.domain;
    return steps * std::max({std::abs(domain.xmin), std::abs(domain.xmax), std::abs(domain.ymin),
                             std::abs(domain.ymax), std::abs(site.x), std::abs(site.y)});
  }

  /// The distance from a cell's site to its farthest corner, or neighbor.
  [[nodiscard]] double reachOf(std::size_t cell, std::span<const std::int32_t> row,
                               const std::vector<AnchoredPoint>& corners) const {
    const Point site{sites_.x[cell], sites_.y[cell]};
    double reach = 0;
    for (const AnchoredPoint& corner : corners) reach = std::max(reach, lengthOf(relativeTo(site, corner)));
    for (const auto neighbor : row) {
      if (neighbor < 0) continue;
      const auto j = static_cast<std::size_t>(neighbor);
      reach = std::max(reach, lengthOf({sites_.x[j] - site.x, sites_.y[j] - site.y}));
    }
    return reach;
  }

  /// The cells around vertices from which a corner is farther than `most`, relatively.
  std::vector<std::uint32_t> cellsAt(double most) {
    std::vector<std::uint32_t> cells;
    for (std::size_t v = 0; v < width_.size(); ++v) {
      if (!(width_[v] > most)) continue;
      for (const auto cell : tied_.cellsAt(v)) {
        if (fineness_.of(cell) < Fineness::finest) cells.push_back(cell);
      }
    }
    sortWithoutRepeats(cells);
    return cells;
  }

  const ProposedCells& proposed_;
  const SiteSet& sites_;
  const TiedCells& tied_;
  const Fineness& fineness_;
  std::uint32_t fewest_;             ///< ties of a vertex that may be wide
  std::vector<std::uint32_t> ties_;  ///< by vertex: number of ties, each counted twice
  std::vector<double> width_;        ///< by vertex: relative distance of its farthest corner
};

}  // namespace

WideVertices findWideVertices(const ProposedCells& proposed, const TiedCells& tied,
                              const Fineness& fineness) {
  return VertexWidths(proposed, tied, fineness).run();
}

}  // namespace vorpipe::core
