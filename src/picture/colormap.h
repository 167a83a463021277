/// Color maps of 256 entries.
#pragma once

#include <string_view>

#include "backend/backend.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// Returns the palette of one of colormaps(), opaque. Error (input): no color map has this name.
Result<Palette> paletteByName(std::string_view name);

}  // namespace vorpipe::core
