#include "domain/clip_diagram.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "cells/cell_walk.h"
#include "geometry/polygon_measures.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t own_parts_grain = 512;

/// The measures of rings about the same origin; those of holes, which run clockwise, are subtracted.
class RingMeasures {
 public:
  void add(std::span<const Point> ring, bool hole) {
    // Relative to the ring itself: a small ring far from the origin would lose all digits.
    const Point from = ring.front();
    points_.clear();
    for (const Point p : ring) points_.push_back({p.x - from.x, p.y - from.y});
    if (hole) std::ranges::reverse(points_);
    Measures m = measurePolygon(points_);
    m.centroid = {from.x + m.centroid.x, from.y + m.centroid.y};
    const double sign = hole ? -1 : 1;
    sum_.area += sign * m.area;
    sum_.perimeter += m.perimeter;
    first_ = {first_.x + sign * m.area * m.centroid.x, first_.y + sign * m.area * m.centroid.y};
    const std::array<double, 3> moved{m.centroid.x * m.centroid.x, m.centroid.x * m.centroid.y,
                                      m.centroid.y * m.centroid.y};
    for (std::size_t k = 0; k < 3; ++k) {
      sum_.second_moments[k] += sign * (m.second_moments[k] + m.area * moved[k]);
    }
    if (ring_count_++ == 0) sum_.centroid = m.centroid;
  }

  [[nodiscard]] Measures total() const {
    Measures m = sum_;
    if (m.area > 0) m.centroid = {first_.x / m.area, first_.y / m.area};
    const std::array<double, 3> moved{m.centroid.x * m.centroid.x, m.centroid.x * m.centroid.y,
                                      m.centroid.y * m.centroid.y};
    for (std::size_t k = 0; k < 3; ++k) m.second_moments[k] -= m.area * moved[k];
    return m;
  }

 private:
  std::vector<Point> points_;
  Measures sum_;
  Point first_{0, 0};
  int ring_count_ = 0;
};

/// Measures cells, one by one. For one thread.
class PartMeasures {
 public:
  PartMeasures(const ClippedRun& run, const OutlineIndex& index, const ClippedCells& clipped,
               Diagram& diagram)
      : run_(run), index_(index), joined_(clipped), diagram_(diagram), unscale_(run.exponent), clip_(index) {}

  /// Returns the part of a cell with these corners, if it is cut.
  std::optional<ClippedCell> measure(std::uint32_t cell, std::span<const AnchoredPoint> corners) {
    using Outcome = OutlineClip::Outcome;
    const auto i = run_.set.id[cell];
    placeCorners(corners);
    switch (outcome()) {
      case Outcome::inside:
        takeWhole(i, cell, corners);
        return {};
      case Outcome::outside:
        takeNothing(i);
        return {};
      case Outcome::cut:
        takePart(i, clipped_);
        return std::exchange(clipped_, {});
      case Outcome::crossed:
        break;
    }
    // A polygon that ties have turned around may cross itself.
    if (joined_.fate[i] != Fate::cut) return {};
    takePart(i, *joined_.parts[i]);
    return *joined_.parts[i];
  }

 private:
  /// Rounds the corners and keeps each place once.
  void placeCorners(std::span<const AnchoredPoint> corners) {
    points_.clear();
    for (const auto& corner : corners) {
      const Point p = positionOf(corner);
      if (points_.empty() || points_.back() != p) points_.push_back(p);
    }
    while (points_.size() > 1 && points_.back() == points_.front()) points_.pop_back();
  }

  OutlineClip::Outcome outcome() {
    using Outcome = OutlineClip::Outcome;
    if (points_.size() < 3) return Outcome::crossed;
    index_.edgesIn(boxOf(points_), near_);
    if (near_.empty()) return index_.contains(points_[0]) ? Outcome::inside : Outcome::outside;
    labels_.assign(points_.size(), 0);
    return clip_.clip(points_, labels_, near_, clipped_);
  }

  /// Measures a whole cell; if its joined polygon is whole, too, the box's measures stay.
  void takeWhole(std::size_t i, std::uint32_t cell, std::span<const AnchoredPoint> corners) {
    if (joined_.fate[i] == Fate::inside) return;
    const Point origin = measuringOrigin(run_.set, cell, corners.front());
    write(i, origin, measureCell(origin, corners));
  }

  void takeNothing(std::size_t i) {
    if (joined_.fate[i] == Fate::outside) return;
    if (joined_.fate[i] == Fate::cut) takePart(i, *joined_.parts[i]);  // for its centroid
    diagram_.area[i] = 0;
    diagram_.second_moments[i] = {};
  }

  void takePart(std::size_t i, const ClippedCell& part) {
    RingMeasures measures;
    const Point origin = part.vertices.front();
    for (std::size_t r = 0; r < part.ring_starts.size(); ++r) {
      points_.clear();
      for (const Point p : part.ring(r)) points_.push_back({p.x - origin.x, p.y - origin.y});
      measures.add(points_, part.hole[r]);
    }
    write(i, origin, measures.total());
  }

  void write(std::size_t i, Point origin, const Measures& m) {
    if (joined_.fate[i] == Fate::outside) {
      if (!(m.area > 0)) return;
      diagram_.status[i] = Status::ok;
    }
    diagram_.area[i] = unscale_(m.area, 2);
    diagram_.centroid[i] = unscale_(Point{origin.x + m.centroid.x, origin.y + m.centroid.y});
    for (std::size_t k = 0; k < 3; ++k) diagram_.second_moments[i][k] = unscale_(m.second_moments[k], 4);
  }

  const ClippedRun& run_;
  const OutlineIndex& index_;
  const ClippedCells& joined_;
  Diagram& diagram_;
  Unscale unscale_;
  OutlineClip clip_;
  std::vector<Point> points_;
  std::vector<std::int64_t> labels_;
  std::vector<std::uint32_t> near_;
  ClippedCell clipped_;
};

}  // namespace

OwnParts measureOwnParts(const ClippedRun& run, const OutlineIndex& index, const ClippedCells& clipped,
                         std::span<const std::uint32_t> near, Diagram& diagram) {
  struct Part {
    std::uint32_t cell;
    ClippedCell rings;
  };
  std::vector<std::vector<Part>> found((near.size() + own_parts_grain - 1) / own_parts_grain);
  parallelFor(near.size(), own_parts_grain, run.threads, [&](std::size_t begin, std::size_t end) {
    PartMeasures measures(run, index, clipped, diagram);
    auto& parts = found[begin / own_parts_grain];
    CellWalk walk(run.set, run.rows);
    walk(near.subspan(begin, end - begin), [&](std::uint32_t cell, auto, auto corners) {
      if (auto part = measures.measure(cell, corners)) parts.push_back({cell, std::move(*part)});
    });
    std::ranges::sort(parts, {}, &Part::cell);
  });
  OwnParts all;
  for (auto& parts : found) {
    for (auto& [cell, rings] : parts) {
      all.cells.push_back(cell);
      all.parts.push_back(std::move(rings));
    }
  }
  return all;
}

}  // namespace vorpipe::core
