/// Where the pixels of a picture lie, as a world file beside it says.
#pragma once

#include <optional>
#include <string>

#include "vorpipe.h"

namespace vorpipe {

/// The box of width x height pixels by the world file beside `path`, whose extension is one of .pgw, .pngw,
/// .tfw and .wld: six numbers, the first and the fourth the size of a pixel, the fourth less than 0, the last
/// two the center of the upper left one. Nothing: there is no such file. Errors (input): it has other
/// numbers, pixels of no size, or turned ones.
Result<std::optional<Box>> boxBeside(const std::string& path, int width, int height);

}  // namespace vorpipe
