/// Pictures that are larger than the drawn part.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

/// Extends an image of the frame's size to width x height pixels. Pixels outside the frame have no site and
/// color 0. Takes no further memory if the image's arrays have room for all.
void putIntoFrame(const PictureFrame& frame, int width, int height, Image& image);

/// partOf() copies a part of an image, of at least one pixel; putPart() writes it back in its place.
Image partOf(const Image& image, const PictureFrame& part);
void putPart(const Image& from, const PictureFrame& part, Image& image);

}  // namespace vorpipe::core
