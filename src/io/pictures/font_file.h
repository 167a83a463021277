/// The font of the panel and of texts in PDFs.
#pragma once

#include <span>

namespace vorpipe {

/// The bytes of a TrueType font with Latin, Greek and Cyrillic letters.
std::span<const unsigned char> fontFile();

}  // namespace vorpipe
