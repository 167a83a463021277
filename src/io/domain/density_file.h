/// Densities out of a file of any known kind.
#pragma once

#include <string>

#include "vorpipe.h"

namespace vorpipe {

/// Reads a density by the path's extension, the top row first: .png, whose darkness it is (readPngDarkness),
/// as stippling wants it; or .npy, an array of shape (H, W) of float32, float64, uint8, uint16 or uint32,
/// whose elements it is. Errors: a path or data that is wrong, a negative element or one that is not finite
/// (input); reading failed or memory ran out (device).
Result<Density> readDensity(const std::string& path);

}  // namespace vorpipe
