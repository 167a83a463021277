/// Id images as NumPy arrays.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// Writes width x height ids, the top row first, as uint32 of shape (height, width). Error (device):
/// writing failed.
Result<void> writeNpyIds(ByteSink& sink, int width, int height, std::span<const std::uint32_t> ids);

/// Reads an array of shape (H, W) of int32, uint32, int64 or uint64 into width, height and ids; rgba
/// stays empty. 4294967295 and, in a signed array, -1 are no_site. Errors: another type or shape, an
/// element that is no id, a damaged file (input); reading failed or memory ran out (device).
Result<Image> readNpyIds(const std::string& path);

}  // namespace vorpipe
