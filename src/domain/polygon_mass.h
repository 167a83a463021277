/// The mass of a polygon under a density of pixels.
#pragma once

#include <optional>

#include "domain/density_pixels.h"
#include "domain/pixel_rows.h"

namespace vorpipe::core {

struct PolygonMass {
  double mass = 0;
  Point center{0, 0};  ///< of the mass, seen from where the polygon was; only where there is mass
  double spread = 0;   ///< integral of the squared distance to the center
};

/// Weighs one polygon after the other, as measureMass says. For one thread; the pixels outlive it.
class PolygonScale {
 public:
  explicit PolygonScale(const DensityPixels& pixels) : pixels_(pixels) {}

  /// Begins a polygon whose points are seen from `origin`, and lie in `around`. Where that is in one pixel,
  /// returns its density, and nothing is to be added: the mass is this times the area.
  std::optional<double> begin(Point origin, const Box& around);

  /// Adds an edge; the polygon lies to its left.
  void add(Point a, Point b) { rows_.add(inPixels(a), inPixels(b)); }

  PolygonMass weigh();

 private:
  [[nodiscard]] Point inPixels(Point p) const {
    return {(p.x - around_.xmin) / pixels_.x.size, (p.y - around_.ymin) / pixels_.y.size};
  }

  const DensityPixels& pixels_;
  Box around_{};
  PixelRows rows_;
};

}  // namespace vorpipe::core
