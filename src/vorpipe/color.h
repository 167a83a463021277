/// Colors as people name them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "vorpipe/result.h"

namespace vorpipe {

/// A color of sRGB, as in Image::rgba: R in the lowest byte, opacity in the highest.
struct Color {
  std::uint32_t rgba = 0xFF000000u;

  [[nodiscard]] std::uint32_t alpha() const { return rgba >> 24; }
  [[nodiscard]] bool isOpaque() const { return alpha() == 0xFF; }
  bool operator==(const Color&) const = default;
};

/// Reads `#rgb`, `#rgba`, `#rrggbb`, `#rrggbbaa`, one of the 148 names of CSS, or `transparent`; in any case.
/// Error (input), which quotes the text: it is none of these.
Result<Color> readColor(std::string_view text);

/// Returns `#rrggbb`, or `#rrggbbaa` if the color is not opaque: what readColor reads back.
std::string textOf(Color color);

}  // namespace vorpipe
