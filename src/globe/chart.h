/// A plane that touches the sphere, on which great circles are lines.
#pragma once

#include "globe/direction.h"

namespace vorpipe::core {

/// The gnomonic projection around a center (Snyder 1987, chapter 22), for places less than 90 degrees from
/// it. Cells on the sphere are those of a plane power diagram there: x . v, for x = center + u right + v up,
/// is largest for the site of least power (globe.md).
class Chart {
 public:
  explicit Chart(Point center);

  [[nodiscard]] Point toPlane(const Direction& at) const;
  [[nodiscard]] Direction toDirection(Point at) const;
  /// The plane's sites, of all sites on the sphere.
  [[nodiscard]] Sites toPlane(const SphereSites& sites, int threads) const;

 private:
  Direction center_, right_, up_;
};

}  // namespace vorpipe::core
