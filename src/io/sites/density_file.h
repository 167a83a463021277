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

/// Reads a density by the path's extension, the top row first: .png, .jpg or .jpeg, whose darkness is the
/// density (readPngDarkness), as for stippling; or .npy, an array of shape (H, W) of numbers that
/// areNumbers() takes. The pixels lie in `box`; without a box, a world file or GDAL's .aux.xml beside the
/// path may say where. Errors: a path or data that is wrong, a negative element or one that is not finite
/// (input); reading failed or memory ran out (device).
Result<DensityFile> readDensity(const std::string& path, const std::optional<Box>& box = {});

/// Sets the box of the pixels in `path`, and its system, from a world file beside it, else from GDAL's
/// .aux.xml; neither if there is none. `read` has the numbers of pixels. Errors (input): a file has other
/// numbers, pixels of no size, turned ones, or an unknown system.
Result<void> findPlace(const std::string& path, DensityFile& read);

}  // namespace vorpipe
