/// What the coordinates of an input are.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "vorpipe.h"

namespace vorpipe {

enum class CoordinateKind : std::uint8_t {
  unknown,  ///< nothing says
  degrees,  ///< longitude and latitude on the Earth
  plane,    ///< a plane, such as a projection of the Earth
};

/// A coordinate system, as far as files name it.
struct CoordinateSystem {
  CoordinateKind kind = CoordinateKind::unknown;
  std::string organization{};  ///< who gave the code: "EPSG"; empty where there is none
  std::int64_t code = 0;       ///< 4326
  std::string definition{};    ///< in WKT; empty where it is not known
  /// Of a plane that --project makes: the longitude and latitude that Lambert's azimuthal equal-area
  /// projection of WGS 84 is centered at; lengths are kilometers.
  std::optional<Point> equal_area_center{};
};

/// WGS 84, longitude before latitude: that of GeoJSON.
inline CoordinateSystem wgs84() { return {CoordinateKind::degrees, "EPSG", 4326, {}, {}}; }

}  // namespace vorpipe
