/// The legend of a picture in its pixels.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

/// Draws boxes and texts over the colors of a picture; its ids stay as they are.
void drawLegend(const Legend& legend, Image& image);

}  // namespace vorpipe::core
