/// Where the pixels of a picture lie, as files beside it say.
#pragma once

#include <optional>
#include <string>

#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

struct PixelPlace {
  std::optional<Box> box{};   ///< none: no file says it
  CoordinateSystem system{};  ///< of that box
};

/// The place of width x height pixels in `path`: by the world file beside it, whose extension is one of .pgw,
/// .pngw, .tfw and .wld: six numbers, the first and the fourth the size of a pixel, the fourth less than 0,
/// the last two the center of the upper left one; else by the GeoTransform of what GDAL writes beside it,
/// `path`.aux.xml. Its system is that of such a file, or of a .prj beside it. Errors (input): one of them has
/// other numbers, pixels of no size, turned ones, or no system that is known.
Result<PixelPlace> placeBeside(const std::string& path, int width, int height);

}  // namespace vorpipe
