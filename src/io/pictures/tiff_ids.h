/// Id images as GeoTIFF, for maps.
#pragma once

#include <cstdint>
#include <span>

#include "io/base/byte_sink.h"
#include "io/base/coordinate_system.h"
#include "io/pictures/georeference.h"
#include "vorpipe.h"

namespace vorpipe {

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
