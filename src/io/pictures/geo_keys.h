/// Coordinate systems as GeoTIFF keys.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/base/coordinate_system.h"

namespace vorpipe {

/// TIFF tags that hold the numbers and the text of keys; the key directory refers to them.
inline constexpr std::uint16_t geo_doubles_tag = 34736, geo_ascii_tag = 34737;

/// The contents of the three tags that name a coordinate system: GeoKeyDirectory, GeoDoubleParams and
/// GeoAsciiParams. The file omits empty ones.
struct GeoKeys {
  std::vector<std::uint16_t> directory;
  std::vector<double> doubles;
  std::string ascii;
};

/// Returns the keys of a system; empty if it is unknown, or is a plane that neither an EPSG code nor a center
/// defines.
GeoKeys geoKeysOf(const CoordinateSystem& system);

}  // namespace vorpipe
