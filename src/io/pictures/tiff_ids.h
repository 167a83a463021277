/// Id images as GeoTIFF, which maps are made of.
#pragma once

#include <cstdint>
#include <span>

#include "io/base/byte_sink.h"
#include "io/base/coordinate_system.h"
#include "io/pictures/georeference.h"
#include "vorpipe.h"

namespace vorpipe {

/// What a GeoTIFF says of its pixels besides their values, and how it is made.
struct TiffOptions {
  PixelGrid grid;
  CoordinateSystem system{};
  int threads = 0;  ///< that compress: 0 for all
  /// A longer file becomes a BigTIFF, as its offsets take 64 bits; less is for tests.
  std::uint64_t longest_classic = 0xFFFFFFFF;
};

/// Writes width x height ids, the top row first, as a TIFF (revision 6.0) of one band of uint32, compressed
/// by Deflate with horizontal differences in strips, and with the tags of GeoTIFF 1.1: where pixels lie, and
/// in what coordinate system, as far as that is known by its EPSG code or made by --project; degrees without
/// a code are those of WGS 84. no_site is the value of pixels without data. The same ids give the same bytes.
/// Error (device): writing failed or memory ran out.
Result<void> writeTiffIds(ByteSink& sink, int width, int height, std::span<const std::uint32_t> ids,
                          const TiffOptions& options);

}  // namespace vorpipe
