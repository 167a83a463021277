/// What cells on a sphere measure, and the Earth's area in them.
#pragma once

#include "globe/sphere_cells.h"

namespace vorpipe::core {

struct SphereMeasures {
  double solid_angle = 0;  ///< steradians
  double area = 0;         ///< km2 on the ellipsoid WGS 84
  double perimeter = 0;    ///< radians
  Direction centroid{};    ///< the direction of the cell's center of mass on the sphere
};

/// Measures a cell that has edges. `lengths`, if not empty, become those of its edges, in radians.
SphereMeasures measureCell(const SphereSites& sites, const SphereCell& cell, std::span<double> lengths);

/// Measures what rings enclose, on their left; ring k of `vertices` ends before ends[k]. Sides are great
/// circles shorter than half a turn. `lengths` becomes theirs, in radians.
SphereMeasures measureRings(std::span<const Direction> vertices, std::span<const std::size_t> ends,
                            std::span<double> lengths);

/// What a site alone on the sphere has.
SphereMeasures wholeSphere(const Direction& site);

}  // namespace vorpipe::core
