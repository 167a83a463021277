/// Coordinate systems as GeoTIFF names them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/base/coordinate_system.h"

namespace vorpipe {

/// Tags of TIFF where the numbers and the text of keys stand, to which the directory of keys refers.
inline constexpr std::uint16_t geo_doubles_tag = 34736, geo_ascii_tag = 34737;

/// The contents of the three tags that name a coordinate system: GeoKeyDirectory, GeoDoubleParams and
/// GeoAsciiParams. Empty ones are left out of the file.
struct GeoKeys {
  std::vector<std::uint16_t> directory;
  std::vector<double> doubles;
  std::string ascii;
};

/// Empty where the system is unknown, or is a plane that neither an EPSG code nor a center defines.
GeoKeys geoKeysOf(const CoordinateSystem& system);

}  // namespace vorpipe
