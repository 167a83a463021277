/// Angles of places on the Earth.
#pragma once

#include <numbers>

#include "vorpipe/sites.h"

namespace vorpipe {

inline constexpr double degree = std::numbers::pi / 180;      ///< in radians
inline constexpr double quarter_turn = 90, whole_turn = 360;  ///< in degrees

/// A latitude, as sine and cosine.
struct Latitude {
  double sine, cosine;
};

/// The authalic latitude of a geodetic one, in degrees from -90 to 90: that on the sphere of equal area.
Latitude authalic(double latitude);

/// The geodetic latitude, in degrees, of an authalic one, in radians.
double geodetic(double authalic_angle);

/// Error (input): there are no sites, or one is no place on the Earth.
Result<void> checkPlaces(const Sites& degrees);

}  // namespace vorpipe
