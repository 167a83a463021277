/// Pictures that are larger than what is drawn.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

/// Makes an image of the frame's size one of width x height pixels; those beside the frame have no site and
/// color 0. Takes no memory besides where the image's arrays have room for all.
void putIntoFrame(const PictureFrame& frame, int width, int height, Image& image);

/// A part of an image, of at least one pixel, and the same back in its place.
Image partOf(const Image& image, const PictureFrame& part);
void putPart(const Image& from, const PictureFrame& part, Image& image);

}  // namespace vorpipe::core
