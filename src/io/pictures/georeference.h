/// Locates the pixels of a picture in the coordinates of its sites: world files, and id images as GeoTIFF.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/base/byte_sink.h"
#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// A grid of equal pixels; its corner is the upper left one of the pixel in row 0 and column 0.
struct PixelGrid {
  double left, top;      ///< x and y of the corner
  double width, height;  ///< of a pixel, above 0
};

/// Returns the pixel grid of a picture that shows `box` in `frame`.
PixelGrid pixelGridOf(const Box& box, const PictureFrame& frame);

/// Writes a world file (.pgw): six lines, which give the x and y of the center of column c and row r as
/// x = line 1 * c + line 3 * r + line 5, y = line 2 * c + line 4 * r + line 6. Error (device): writing
/// failed.
Result<void> writeWorldFile(ByteSink& sink, const PixelGrid& grid);

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

/// Metadata of a GeoTIFF's pixels, and how to write it.
struct TiffOptions {
  PixelGrid grid;
  CoordinateSystem system{};
  int threads = 0;  ///< for compression; 0 for all
  /// A longer file becomes a BigTIFF, with 64-bit offsets; smaller limits are for tests.
  std::uint64_t longest_classic = 0xFFFFFFFF;
};

/// Writes width x height ids, the top row first, as a TIFF (revision 6.0) of one band of uint32, compressed
/// by Deflate with horizontal differences in strips, and with the tags of GeoTIFF 1.1: the place of pixels,
/// and their coordinate system if it has an EPSG code or is made by --project; degrees without a code are
/// those of WGS 84. no_site is the value of pixels without data. The same ids give the same bytes. Error
/// (device): writing failed or memory ran out.
Result<void> writeTiffIds(ByteSink& sink, int width, int height, std::span<const std::uint32_t> ids,
                          const TiffOptions& options);

}  // namespace vorpipe
