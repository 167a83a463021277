/// Draws lines over a picture.
#pragma once

#include <span>

#include "vorpipe.h"
#include "vorpipe/shapes.h"

namespace vorpipe::core {

/// Maps pixels of an image to places of a picture: the picture's own pixels, or several rows and columns of
/// places in each.
struct Places {
  double left = 0, top = 0;  ///< where the image begins, in pixels of the picture
  int in_pixel = 1;          ///< rows and columns of places in a pixel

  [[nodiscard]] double x(int column) const { return left + (column + 0.5) / in_pixel; }
  [[nodiscard]] double y(int row) const { return top + (row + 0.5) / in_pixel; }
};

/// Colors the places that have a site and are at most half of `width` pixels from one of the lines.
void drawLines(std::span<const Line> lines, double width, std::uint32_t color, const Places& places,
               int threads, Image& image);

}  // namespace vorpipe::core
