/// Finds where the pixels of a picture lie, from files beside it.
#pragma once

#include <optional>
#include <string>

#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

struct PixelPlace {
  std::optional<Box> box{};   ///< none: no file gives it
  CoordinateSystem system{};  ///< of that box
};

/// Returns the place of width x height pixels in `path`, from the world file beside it, whose extension is
/// one of .pgw, .pngw, .tfw and .wld: six numbers, the first and the fourth the size of a pixel, the fourth
/// less than 0, the last two the center of the upper left one; else from the GeoTransform that GDAL writes to
/// `path`.aux.xml. The system is from that file or a .prj beside it. Errors (input): a file has other
/// numbers, pixels of no size, turned ones, or an unknown system.
Result<PixelPlace> placeBeside(const std::string& path, int width, int height);

}  // namespace vorpipe
