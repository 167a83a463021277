/// Where the cell under the pointer ends, in a picture.
#pragma once

#include <vector>

#include "view/window/event.h"
#include "vorpipe/picture.h"

namespace vorpipe::view {

/// Returns a closed line around the connected pixels that show the same site as the one at (row, column), in
/// pixels of the image, y downward; corners of pixels are cut. Empty beyond the image, or where there is no
/// site. With a hole between the pixel and the image's left side, the line may be that around the hole.
std::vector<Position> borderAround(const Image& image, int row, int column);

}  // namespace vorpipe::view
