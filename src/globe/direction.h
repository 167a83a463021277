/// Directions from the center of the Earth: unit vectors, and the places that they point to.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "vorpipe/sites.h"

namespace vorpipe::core {

/// A vector in space; a unit vector where it stands for a place. z points to the north pole, x to longitude
/// 0.
struct Direction {
  double x, y, z;
  friend auto operator<=>(const Direction&, const Direction&) = default;
};

inline Direction operator+(const Direction& a, const Direction& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Direction operator-(const Direction& a, const Direction& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Direction operator-(const Direction& a) { return {-a.x, -a.y, -a.z}; }
inline Direction operator*(double by, const Direction& a) { return {by * a.x, by * a.y, by * a.z}; }
inline double dot(const Direction& a, const Direction& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Direction cross(const Direction& a, const Direction& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double lengthOf(const Direction& a) { return std::sqrt(dot(a, a)); }
inline Direction normalized(const Direction& a) { return 1 / lengthOf(a) * a; }

/// Vectors side by side, for loops over them that are vectorized.
template <std::size_t lanes>
struct DirectionLanes {
  std::array<double, lanes> x{}, y{}, z{};
  void set(std::size_t k, const Direction& a) { x[k] = a.x, y[k] = a.y, z[k] = a.z; }
  [[nodiscard]] Direction at(std::size_t k) const { return {x[k], y[k], z[k]}; }
};

/// Some unit vector at right angles to another one.
Direction perpendicular(const Direction& a);

/// The direction of a place in degrees of longitude, of any turn, and latitude. Multiples of 90 degrees are
/// exact, and places that mirror each other in a coordinate plane have directions that do.
Direction directionOf(Point degrees);

/// The sites of a sphere. A weight w of a site makes it a cap of angular radius r = sqrt(w) / R, and its cell
/// is where x . p / cos(r) is largest among the sites (Sugihara 2002, Laguerre Voronoi diagram on the
/// sphere): cells are what planes through the sites' vectors p / cos(r) support.
struct SphereSites {
  BigVector<Direction> direction;
  BigVector<double> excess;     ///< by site: 1 / cos(r) - 1; empty without weights
  BigVector<Direction> scaled;  ///< by site: p / cos(r); empty without weights

  [[nodiscard]] std::span<const Direction> vectors() const { return scaled.empty() ? direction : scaled; }
  [[nodiscard]] double excessOf(std::size_t site) const { return excess.empty() ? 0 : excess[site]; }
};

/// How far a site's vector is below the plane through another's that is at right angles to it.
inline double depthOf(const SphereSites& sites, std::size_t other, std::size_t site) {
  const Direction way = sites.direction[site] - sites.direction[other];
  const double excess = sites.excessOf(site);
  return sites.excessOf(other) - excess + (1 + excess) * dot(way, way) / 2;
}

/// 1 / cos(r) - 1 for a weight in km2; a negative one is that of an imaginary radius.
double excessOf(double weight);

/// The sites of a sphere, given in degrees.
SphereSites placedOn(const Sites& sites, int threads);

/// The vector of a site, as in SphereSites.
Direction vectorOf(const Sites& sites, std::size_t site);

/// Radius in km of the sphere whose area is that of the ellipsoid WGS 84.
double earthRadius();

/// The place in a direction: its longitude in (-180, 180], 0 at the poles.
Point placeOf(const Direction& direction);

/// The angle, in radians, between two unit vectors.
inline double angleBetween(const Direction& a, const Direction& b) {
  return std::atan2(lengthOf(cross(a, b)), dot(a, b));
}

}  // namespace vorpipe::core
