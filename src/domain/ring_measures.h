/// Measures of polygons with holes.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "geometry/polygon_measures.h"

namespace vorpipe::core {

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

}  // namespace vorpipe::core
