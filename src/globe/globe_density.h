/// A density over the Earth.
#pragma once

#include "globe/direction.h"
#include "vorpipe/sites.h"

namespace vorpipe::core {

/// Pixels in degrees of longitude and latitude, read between their centers. The density, which outlives this,
/// is valid.
class GlobeDensity {
 public:
  /// Without a box of its own the density covers the Earth. Longitudes of the box are of any turn.
  explicit GlobeDensity(const Density& density);

  /// Bilinear between the centers of four pixels; across the box's sides where it goes around the Earth, and
  /// that of the outermost center beyond it. 0 outside of the box.
  [[nodiscard]] double at(const Direction& place) const;

  /// Height of a pixel, in radians.
  [[nodiscard]] double pixel() const { return pixel_; }

 private:
  const Density& density_;
  Box box_;
  double pixel_;
  double columns_per_degree_, rows_per_degree_;
  bool is_around_;  ///< the box has all longitudes
};

/// The box of a density on the globe.
Box boxOnGlobe(const Density& density);

/// Refuses a density that has no place on the globe: its box is wider than a turn, or reaches beyond a pole.
/// Error (input).
Result<void> checkOnGlobe(const Density& density);

}  // namespace vorpipe::core
