/// Densities out of a file of any known kind.
#pragma once

#include <optional>
#include <string>

#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

struct DensityFile {
  Density density{};          ///< with a box where a file beside says where it lies
  CoordinateSystem system{};  ///< of that box, as a file beside says
};

/// Reads a density by the path's extension, the top row first: .png, whose darkness it is (readPngDarkness),
/// as stippling wants it; or .npy, an array of shape (H, W) of numbers that areNumbers() takes. The pixels
/// lie in `box`; without a box placeBeside() says where. Errors: a path or data that is wrong, a negative
/// element or one that is not finite, those of placeBeside() (input); reading failed or memory ran out
/// (device).
Result<DensityFile> readDensity(const std::string& path, const std::optional<Box>& box = {});

}  // namespace vorpipe
