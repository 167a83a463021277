/// An equal-area projection of the Earth to a plane.
#pragma once

#include "vorpipe/cells.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// Lambert's azimuthal equal-area projection of the ellipsoid WGS 84 (Snyder 1987, Map Projections: A Working
/// Manual, chapter 24): degrees of longitude and latitude to kilometers east and north of a center, and back.
/// Areas are those on the ellipsoid; distances are true near the center.
class Projection {
 public:
  /// Projection around a center. Error (input): the center is not a place on the Earth.
  static Result<Projection> around(Point degrees);

  [[nodiscard]] Point center() const { return center_; }
  /// Projects a place to the plane. Its longitude may be of any turn; its latitude is from -90 to 90.
  [[nodiscard]] Point toPlane(Point degrees) const;
  /// The inverse; longitudes are within 180 degrees of the center's. Returns NaN for a place beyond the
  /// Earth's edge.
  [[nodiscard]] Point toDegrees(Point kilometers) const;

 private:
  Projection() = default;
  Point center_{};                ///< degrees
  double sine_ = 0, cosine_ = 0;  ///< of its authalic latitude
  double stretch_ = 1;            ///< factor that makes the scale true at the center
};

}  // namespace vorpipe
