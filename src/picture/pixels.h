/// Pixels of an image: their colors, and parts of all of them.
#pragma once

#include <cstddef>

#include "vorpipe.h"

namespace vorpipe::core {

inline std::size_t pixelAt(const Image& image, int row, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
         static_cast<std::size_t>(column);
}

/// Returns the rows of a box from `first` to before `last` of `rows`, counted from its upper end.
Box boxOfRows(const Box& box, int first, int last, int rows);

/// Returns a color, which may be translucent, over another one, where it covers a part. Alpha is not
/// premultiplied.
std::uint32_t mixed(std::uint32_t color, double part, std::uint32_t below);

/// Blends a color, which may be translucent, over a pixel of which it covers a part. Does nothing beyond the
/// picture. Alpha is not premultiplied.
void blend(Image& image, int row, int column, std::uint32_t color, double part);

/// Blends a color over a box of pixels, whose sides are rounded to whole ones.
void blendBox(const Box& box, std::uint32_t color, Image& image);

/// Lays a picture over a color, which fills all that is transparent.
void layOver(std::uint32_t background, Image& image);

/// Makes all pixels transparent; ids stay.
void clearColors(Image& image);

/// Extends an image of the frame's size to width x height pixels. Pixels outside the frame have no site and
/// color 0. Takes no further memory if the image's arrays have room for all.
void putIntoFrame(const PictureFrame& frame, int width, int height, Image& image);

/// partOf() copies a part of an image, of at least one pixel; putPart() writes it back in its place.
Image partOf(const Image& image, const PictureFrame& part);
void putPart(const Image& from, const PictureFrame& part, Image& image);

}  // namespace vorpipe::core
