/// Replaces moments of a cell's area by moments of its mass.
#pragma once

#include <span>

#include "domain/polygon_mass.h"

namespace vorpipe::core {

/// Destination of the moments of cells' masses, by site. It contains those of areas before.
struct MassRecords {
  std::span<const double> area;
  std::span<double> mass;
  std::span<Point> center;     ///< the centroid if there is no mass
  std::span<double> spread{};  ///< integral of the squared distance to the center; empty: not requested
};

/// Computes the moments of mass of cells, one by one. For one thread.
class Weighing {
 public:
  Weighing(const DensityPixels& pixels, const MassRecords& records) : records_(records), scale_(pixels) {}

  /// Weighs the cell of site i, whose vertices are relative to `origin`; each_edge(take) calls take(a, b) for
  /// each of its edges.
  template <class EachEdge>
  void weigh(std::size_t i, Point origin, std::span<const Point> vertices, const EachEdge& each_edge) {
    if (const auto value = scale_.begin(origin, boxOf(vertices))) {
      records_.mass[i] = *value * records_.area[i];
      if (!records_.spread.empty()) records_.spread[i] *= *value;
      return;
    }
    each_edge([this](Point a, Point b) { scale_.add(a, b); });
    const PolygonMass weighed = scale_.weigh();
    records_.mass[i] = weighed.mass;
    if (!records_.spread.empty()) records_.spread[i] = weighed.spread;
    if (!(weighed.mass > 0)) return;
    records_.center[i] = {origin.x + weighed.center.x, origin.y + weighed.center.y};
  }

  /// The same, for one ring.
  void weigh(std::size_t i, Point origin, std::span<const Point> ring) {
    weigh(i, origin, ring, [&](const auto& take) { eachSide(ring, take); });
  }

  /// For a cell without area.
  void weighNothing(std::size_t i) {
    records_.mass[i] = 0;
    if (!records_.spread.empty()) records_.spread[i] = 0;
  }

  template <class Take>
  static void eachSide(std::span<const Point> ring, const Take& take) {
    for (std::size_t k = 0; k < ring.size(); ++k) take(ring[k], ring[k + 1 < ring.size() ? k + 1 : 0]);
  }

 private:
  const MassRecords& records_;
  PolygonScale scale_;
};

}  // namespace vorpipe::core
