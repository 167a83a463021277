/// What the coordinates of an input are.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

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
  /// Of degrees that come back from such a plane, where edges are straight: its center. A ring around a pole
  /// has all longitudes within 180 degrees of that, and one edge from the last to the first.
  std::optional<Point> from_plane_around{};
};

/// WGS 84, longitude before latitude: that of GeoJSON.
inline CoordinateSystem wgs84() { return {CoordinateKind::degrees, "EPSG", 4326, {}, {}}; }

/// The system of a code of EPSG.
CoordinateSystem systemOfCode(std::int64_t code);

/// The system that a text names: EPSG:25832, OGC:CRS84, the same as a URN or as an address of opengis.net, a
/// code alone, which is EPSG's, or a definition in WKT (systemOfWkt). The error is that it names none.
tl::expected<CoordinateSystem, std::string> systemNamed(std::string_view text);

/// Whether it is more than a kind: a code, or a definition.
bool hasName(const CoordinateSystem& system);

/// The system in messages: "EPSG:25832", the name in its definition, or its kind.
std::string nameOf(const CoordinateSystem& system);

/// The system of degrees that are known to be degrees: the one that is named, or WGS 84.
inline CoordinateSystem degreesOf(const CoordinateSystem& system) {
  return system.kind == CoordinateKind::degrees && hasName(system) ? system : wgs84();
}

/// How coordinates of two systems go together.
enum class SystemsAre : std::uint8_t {
  one,      ///< the same, or nothing says otherwise
  near,     ///< degrees that are within some two meters of each other
  unclear,  ///< planes without names, or with some that only a database of all systems can compare
  different
};
SystemsAre compared(const CoordinateSystem& a, const CoordinateSystem& b);

}  // namespace vorpipe
