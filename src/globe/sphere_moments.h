/// Mass, center and energy of cells on the sphere.
#pragma once

#include "globe/globe_density.h"
#include "globe/sphere_cells.h"

namespace vorpipe::core {

/// Integrals over a part of the unit sphere, by quadrature.
struct SphereMoments {
  double area = 0;          ///< steradians
  double mass = 0;          ///< of the density; the area without one
  Direction lean{0, 0, 0};  ///< of x - p by mass, where p is the site
  double energy = 0;        ///< of |x - p|^2 by mass
};

/// Of a site's cell. `density` may be null.
///
/// The cell is cut into triangles from a point inside, and these into halves across their longest sides until
/// no side is longer than 0.02, nor than two pixels' heights of the density. Each has seven points (Radon
/// 1948), exact for polynomials of degree five: without a density rounding alone is left.
SphereMoments momentsOf(const SphereSites& sites, const SphereCell& cell, const GlobeDensity* density);

/// The least energy of `count` cells on the unit sphere: 2 count - 4 equal triangles that meet in the sites
/// (L. Fejes Toth 1953). Sites at the vertices of a tetrahedron, an octahedron or an icosahedron have it;
/// many approach that of hexagons in the plane.
double leastEnergyOnSphere(std::size_t count);

}  // namespace vorpipe::core
