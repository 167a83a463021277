/// Locates the pixels of a picture in the coordinates of its sites.
#pragma once

#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// A grid of equal pixels; its corner is the upper left one of the pixel in row 0 and column 0.
struct PixelGrid {
  double left, top;      ///< x and y of the corner
  double width, height;  ///< of a pixel, above 0
};

/// Returns the pixel grid of a picture that shows `box` in `frame`.
PixelGrid pixelGridOf(const Box& box, const PictureFrame& frame);

/// Writes a world file (.pgw): six lines, which give the x and y of the center of column c and row r as
/// x = line 1 * c + line 3 * r + line 5, y = line 2 * c + line 4 * r + line 6. Error (device): writing
/// failed.
Result<void> writeWorldFile(ByteSink& sink, const PixelGrid& grid);

}  // namespace vorpipe
