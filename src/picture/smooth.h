/// Pictures whose pixels have the mean color of several places.
#pragma once

#include <functional>

#include "picture/strokes.h"

namespace vorpipe::core {

/// Draws the rows of a picture from `first` to before `last` as an image with `places` rows and columns in
/// each pixel, cells and all that is over them.
using DrawPlaces = std::function<Result<Image>(int first, int last)>;

/// Gives each pixel of an image the mean color of its places, as much of it opaque as they have sites; ids
/// stay. Errors: those of `draw`.
Result<void> smooth(const DrawPlaces& draw, int in_pixel, int threads, Image& image);

}  // namespace vorpipe::core
