/// Layout and content of a picture's legend: the same for pixels, SVG and PDF.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vorpipe/picture.h"

namespace vorpipe {

/// The smallest picture, in either direction, that a legend fits into.
inline constexpr PictureSize least_with_legend{100, 64};

/// In pixels from the picture's upper left corner, y downward.
struct LegendBox {
  double left, top, width, height;
  std::uint32_t rgba;  ///< R in the lowest byte; may be translucent
};

enum class Anchor : std::uint8_t { start, middle, end };

struct LegendText {
  double x, baseline;
  double height;  ///< of a capital letter
  Anchor anchor;
  std::string text;  ///< ASCII
};

/// Returns how wide a text is when drawText() draws it, in pixels.
double widthOf(const LegendText& text);

/// Draws a text in black over pixels, smoothed. Its height is rounded to a multiple of 7 pixels.
void drawText(const LegendText& text, Image& image);

/// Boxes are drawn first, each over the previous ones; then texts, in black.
struct Legend {
  std::vector<LegendBox> boxes;
  std::vector<LegendText> texts;
};

/// Returns the legend of a picture of width x height pixels, in its lower left corner. `key` describes its
/// colors in `colormap`, which is one of colormaps().
Legend legendOf(const ColorKey& key, const std::string& colormap, int width, int height);

}  // namespace vorpipe
