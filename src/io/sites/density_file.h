/// Reads densities from a file of any known kind.
#pragma once

#include <optional>
#include <string>

#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

struct DensityFile {
  Density density{};          ///< with a box if a file beside it gives its place
  CoordinateSystem system{};  ///< of that box, from a file beside it
};

/// Reads a density by the path's extension, the top row first: .png, whose darkness is the density
/// (readPngDarkness), as for stippling; or .npy, an array of shape (H, W) of numbers that areNumbers() takes.
/// The pixels lie in `box`; without a box, a world file or GDAL's .aux.xml beside the path may say where.
/// Errors: a path or data that is wrong, a negative element or one that is not finite (input); reading failed
/// or memory ran out (device).
Result<DensityFile> readDensity(const std::string& path, const std::optional<Box>& box = {});

}  // namespace vorpipe
