/// Antialiasing: each pixel gets the mean color of several places.
#pragma once

#include <functional>

#include "picture/strokes.h"

namespace vorpipe::core {

/// Draws the rows of a picture from `first` to before `last` as an image with several rows and columns of
/// places in each pixel, cells and all marks over them.
using DrawPlaces = std::function<Result<Image>(int first, int last)>;

/// Gives each pixel of an image the mean color of its places; its opacity is the share of places with a site.
/// Ids do not change. Errors: those of `draw`.
Result<void> smooth(const DrawPlaces& draw, int in_pixel, int threads, Image& image);

}  // namespace vorpipe::core
