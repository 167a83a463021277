/// Sites and walls as they are seen from one site.
#pragma once

#include <cmath>

#include "space/label.h"

namespace vorpipe::space {

/// The points p, relative to the site that looks, which are as near to a site or as far out as a wall:
/// 2 p . (x, y, z) = lift. Of a site, (x, y, z) is its place and lift its squared distance, and with weights
/// what it is lighter by; of a wall, the outward normal and twice the distance (negative if the site lies
/// beyond). In double each difference is rounded once, so that lift has an error of 5 u times lift_size, with
/// weights of 6 u (of a wall: u), u = 2^-53.
struct Relative {
  double x, y, z, lift;
  double lift_size;  ///< the sum of the magnitudes of the two parts of lift
  /// The sum of the magnitudes of its components.
  [[nodiscard]] double size() const { return std::abs(x) + std::abs(y) + std::abs(z); }
  [[nodiscard]] double squared() const { return (x * x + y * y) + z * z; }
};

inline double coordinate(const Point3& point, int axis) {
  return axis == 0 ? point.x : axis == 1 ? point.y : point.z;
}

inline double wallOffset(const Places& places, Label label) {
  const int wall = wallOf(label);
  const Box3& box = places.box;
  if (axisOf(wall) == 0) return isUpper(wall) ? box.xmax : box.xmin;
  if (axisOf(wall) == 1) return isUpper(wall) ? box.ymax : box.ymin;
  return isUpper(wall) ? box.zmax : box.zmin;
}

inline Relative relative(const Places& places, Label site, Label other) {
  const Point3& from = places.sites[site];
  if (isWallLabel(other)) {
    const int axis = axisOf(wallOf(other));
    const double out = isUpper(wallOf(other)) ? 1 : -1;
    const double distance = out * (wallOffset(places, other) - coordinate(from, axis));
    return {axis == 0 ? out : 0, axis == 1 ? out : 0, axis == 2 ? out : 0, 2 * distance,
            std::abs(2 * distance)};
  }
  const Point3& to = places.sites[other];
  const double x = to.x - from.x, y = to.y - from.y, z = to.z - from.z;
  const double squared = (x * x + y * y) + z * z;
  if (places.weights == nullptr) return {x, y, z, squared, squared};
  const double lighter = places.weights[site] - places.weights[other];
  return {x, y, z, squared + lighter, squared + std::abs(lighter)};
}

}  // namespace vorpipe::space
