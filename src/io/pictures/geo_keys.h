/// Coordinate systems as GeoTIFF names them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/attributes/coordinate_system.h"

namespace vorpipe {

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
