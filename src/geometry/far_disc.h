/// Discs much larger than a polygon, whose centers are far away.
#pragma once

#include "base/double_double.h"
#include "geometry/chord.h"

namespace vorpipe::core {

/// Locates the circle to some 1e-16 of the polygon, not of the disc: the gap between the polygon's corners
/// and the circle is a difference of two large squares, computed in double-double.
class FarDisc {
 public:
  /// `center` is relative to an origin near the polygon, as the polygon's corners are.
  FarDisc(Point center, double squared_radius);

  /// squared_radius - |p - center|^2: negative outside of the disc.
  [[nodiscard]] double inwards(Point p) const;

  struct End {
    Point place;
    double inwards;
  };
  [[nodiscard]] Chord chordOf(const End& begin, const End& end) const;

 private:
  [[nodiscard]] double alongFromCenter(Point p, Point way) const;

  Point center_;
  DoubleDouble origin_inwards_;
};

}  // namespace vorpipe::core
