/// Photographs as JPEG files, through libjpeg.
#pragma once

#include <string>

#include "vorpipe.h"

namespace vorpipe {

/// Reads a JPEG of any kind into width, height and rgba, opaque, turned as its EXIF orientation says; ids
/// stays empty. Colors are taken as sRGB. Errors: no JPEG, a damaged or truncated one (input); reading failed
/// or memory ran out (device).
Result<Image> readJpeg(const std::string& path);

}  // namespace vorpipe
