/// Moments of a cell's mass, for those of its area.
#pragma once

#include <span>

#include "core/cells/polygon_mass.h"

namespace vorpipe::core {

/// Gives one cell after the other the moments of its mass; those of its area stand in `moments`. The center
/// of mass is the centroid where there is none. For one thread.
class Weighing {
 public:
  Weighing(const DensityPixels& pixels, CellMoments& moments) : moments_(moments), scale_(pixels) {}

  /// The cell of site i, whose vertices are seen from `origin`; eachEdge(take) calls take(a, b) for each of
  /// its edges.
  template <class EachEdge>
  void weigh(std::size_t i, Point origin, std::span<const Point> vertices, const EachEdge& each_edge) {
    if (const auto value = scale_.begin(origin, boxOf(vertices))) {
      moments_.mass[i] = *value * moments_.area[i];
      moments_.spread[i] *= *value;
      return;
    }
    each_edge([this](Point a, Point b) { scale_.add(a, b); });
    const PolygonMass weighed = scale_.weigh();
    moments_.mass[i] = weighed.mass;
    moments_.spread[i] = weighed.spread;
    if (!(weighed.mass > 0)) return;
    moments_.centroid[i] = {origin.x + weighed.center.x, origin.y + weighed.center.y};
  }

  /// The same, of one ring.
  void weigh(std::size_t i, Point origin, std::span<const Point> ring) {
    weigh(i, origin, ring, [&](const auto& take) {
      for (std::size_t k = 0; k < ring.size(); ++k) take(ring[k], ring[k + 1 < ring.size() ? k + 1 : 0]);
    });
  }

 private:
  CellMoments& moments_;
  PolygonScale scale_;
};

}  // namespace vorpipe::core
