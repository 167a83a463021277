/// Coordinate systems of inputs, and their definitions in well-known text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe {

enum class CoordinateKind : std::uint8_t {
  unknown,  ///< not stated
  degrees,  ///< longitude and latitude on the Earth
  plane,    ///< a plane, such as a projection of the Earth
};

/// A coordinate system as named by files.
struct CoordinateSystem {
  CoordinateKind kind = CoordinateKind::unknown;
  std::string organization{};  ///< issuer of the code: "EPSG"; empty if there is none
  std::int64_t code = 0;       ///< 4326
  std::string definition{};    ///< in WKT; empty if unknown
  /// For a plane made by --project: longitude and latitude of the center of Lambert's azimuthal equal-area
  /// projection of WGS 84. Lengths are kilometers.
  std::optional<Point> equal_area_center{};
  /// For degrees converted back from such a plane, where edges are straight: its center. A ring around a pole
  /// has all longitudes within 180 degrees of the center, and one edge from the last to the first.
  std::optional<Point> from_plane_around{};
  bool on_globe = false;  ///< for degrees: edges are great circles
};

/// WGS 84, longitude before latitude, as in GeoJSON.
inline CoordinateSystem wgs84() { return {CoordinateKind::degrees, "EPSG", 4326, {}, {}}; }

/// Returns the system of an EPSG code.
CoordinateSystem systemOfCode(std::int64_t code);

/// Returns the system that a text names: EPSG:25832 or OGC:CRS84, either also as a URN or an opengis.net
/// address; a bare EPSG code; or a definition in well-known text, version 1, ESRI's variant or version 2.
/// Error: it names none.
tl::expected<CoordinateSystem, std::string> systemNamed(std::string_view text);

/// Whether the system has a code or a definition, not only a kind.
bool hasName(const CoordinateSystem& system);

/// Returns the system's name for messages: "EPSG:25832", the name in its definition, or its kind.
std::string nameOf(const CoordinateSystem& system);

/// Returns the member "crs" of GeoJSON, with a comma after it: that of a system with a code of EPSG that
/// readers would take for WGS 84 without it. Else nothing.
std::string geoJsonSystem(const CoordinateSystem& system);

/// Returns the system of coordinates known to be degrees: the named one, or WGS 84.
inline CoordinateSystem degreesOf(const CoordinateSystem& system) {
  return system.kind == CoordinateKind::degrees && hasName(system) ? system : wgs84();
}

/// How two coordinate systems compare.
enum class SystemsAre : std::uint8_t {
  one,      ///< the same, or not known to differ
  near,     ///< degrees that agree within about two meters
  unclear,  ///< planes without names, or with names that only a database of all systems can compare
  different
};
SystemsAre compared(const CoordinateSystem& a, const CoordinateSystem& b);

/// The kind of the system that text defines.
CoordinateKind kindOfWkt(std::string_view definition);

/// Square kilometers in a unit of area of a plane whose unit of length is known: from its definition, else by
/// its code of EPSG, if that is of the usual systems in meters. None for degrees, and for a Mercator
/// projection that is not transverse, such as Web Mercator: areas there are not those on the Earth. For a
/// plane of
/// --project, 1.
std::optional<double> squareKilometersIn(const CoordinateSystem& system);

/// Names such areas in legends.
inline constexpr const char* areas_in_kilometers = "area, km\u00B2";

/// Reads the .prj beside a file, "towns.prj" for "towns.csv" and "towns.csv.gz", if it exists and nothing
/// else names the file's system. `system` is the file's, and gets what is read. Errors (input): the .prj is
/// no WKT definition, or its kind of coordinates differs from that of `system`.
Result<void> readSystemBeside(const std::string& path, CoordinateSystem& system);

}  // namespace vorpipe
