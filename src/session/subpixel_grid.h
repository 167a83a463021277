/// The grid that a device snaps vertices to.
#pragma once

#include <optional>

#include "backend/backend.h"

namespace vorpipe::core {

/// Draws edges at places that differ by little, and counts on how many distinct places they end up: how many
/// bits of a place inside a pixel the device keeps, most_subpixel_bits at most; 0 where edges do not move as
/// they should; none where its views are too small to tell. The picture is lost. Error (device): the device
/// failed.
Result<std::optional<int>> measureSubpixelBits(Backend& backend);

}  // namespace vorpipe::core
