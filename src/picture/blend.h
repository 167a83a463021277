/// Blends one color over another in a picture.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "vorpipe.h"

namespace vorpipe::core {

inline std::size_t pixelAt(const Image& image, int row, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
         static_cast<std::size_t>(column);
}

/// Blends a color, which may be translucent, over a pixel of which it covers a part. Does nothing beyond the
/// picture. Alpha is not premultiplied.
inline void blend(Image& image, int row, int column, std::uint32_t color, double part) {
  if (!(part > 0) || row < 0 || row >= image.height || column < 0 || column >= image.width) return;
  constexpr double most = 255;
  std::uint32_t& pixel = image.rgba[pixelAt(image, row, column)];
  const double over = std::min(part, 1.0) * (color >> 24) / most;
  const double under = (1 - over) * (pixel >> 24) / most;
  const double alpha = over + under;
  std::uint32_t mixed = static_cast<std::uint32_t>(std::lround(most * alpha)) << 24;
  for (int shift = 0; shift < 24; shift += 8) {
    const double channel = over * (color >> shift & 0xFF) + under * (pixel >> shift & 0xFF);
    if (alpha > 0) mixed |= static_cast<std::uint32_t>(std::lround(channel / alpha)) << shift;
  }
  pixel = mixed;
}

}  // namespace vorpipe::core
