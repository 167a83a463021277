/// How a device rounds.
#pragma once

#include <optional>

#include "backend/backend.h"

namespace vorpipe::core {

/// Implements Session::arithmetic on an open backend.
Result<Arithmetic> measureArithmetic(Backend& backend);

/// Measures how many bits of a place inside a pixel the device keeps, most_subpixel_bits at most. Draws edges
/// at slightly different places and counts the distinct places where they end up. Returns 0 if edges do not
/// move as they should, and none if the device's views are too small to tell. The picture is lost. Error
/// (device): the device failed.
Result<std::optional<int>> measureSubpixelBits(Backend& backend);

}  // namespace vorpipe::core
