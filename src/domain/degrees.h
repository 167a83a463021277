/// Angles of places on the Earth.
#pragma once

#include <numbers>

#include "vorpipe/sites.h"

namespace vorpipe {

inline constexpr double degree = std::numbers::pi / 180;      ///< in radians
inline constexpr double quarter_turn = 90, whole_turn = 360;  ///< in degrees

/// Error (input): there are no sites, or one is no place on the Earth.
Result<void> checkPlaces(const Sites& degrees);

}  // namespace vorpipe
