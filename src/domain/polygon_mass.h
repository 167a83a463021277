/// The mass of a polygon under a density of pixels.
#pragma once

#include <optional>

#include "domain/density_pixels.h"
#include "domain/pixel_rows.h"

namespace vorpipe::core {

struct PolygonMass {
  double mass = 0;
  Point center{0, 0};  ///< of the mass, relative to the polygon's origin; only if there is mass
  double spread = 0;   ///< integral of the squared distance to the center
};

/// Weighs polygons one by one, as specified for measureMass. For one thread; the pixels outlive this object.
class PolygonScale {
 public:
  explicit PolygonScale(const DensityPixels& pixels) : pixels_(pixels) {}

  /// Begins a polygon whose points are relative to `origin` and lie in `around`. If that is within one pixel,
  /// returns its density, and no edges need be added: the mass is density times area.
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
