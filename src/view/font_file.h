/// The panel's font.
#pragma once

#include <span>

namespace vorpipe::view {

/// The bytes of a TrueType font with Latin, Greek and Cyrillic letters.
std::span<const unsigned char> fontFile();

}  // namespace vorpipe::view
