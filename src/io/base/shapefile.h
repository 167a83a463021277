/// Shapefiles, by GDAL's program ogr2ogr.
#pragma once

#include <string>

#include "vorpipe.h"

namespace vorpipe {

/// The extension of shapefiles.
inline constexpr std::string_view shapefile_extension = ".shp";

/// A shapefile converted to a GeoPackage, which is removed together with this. GDAL converts its attributes,
/// their encoding and its coordinate system, from the files beside it.
class ConvertedShapefile {
 public:
  /// Errors (input): ogr2ogr is not installed, or refuses the file; (device): the disk is full.
  static Result<ConvertedShapefile> of(const std::string& path);

  ConvertedShapefile(ConvertedShapefile&& other) noexcept;
  ConvertedShapefile& operator=(ConvertedShapefile&&) = delete;
  ~ConvertedShapefile();

  /// The GeoPackage.
  [[nodiscard]] std::string file() const { return folder_ + "/converted.gpkg"; }

 private:
  explicit ConvertedShapefile(std::string folder) : folder_(std::move(folder)) {}
  std::string folder_;
};

}  // namespace vorpipe
