/// Angles of places on the Earth.
#pragma once

#include <numbers>

namespace vorpipe {

inline constexpr double degree = std::numbers::pi / 180;      ///< in radians
inline constexpr double quarter_turn = 90, whole_turn = 360;  ///< in degrees

}  // namespace vorpipe
