/// Draws the legend into the pixels of a picture.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

/// Draws boxes and texts over the colors of a picture; its ids do not change.
void drawLegend(const Legend& legend, Image& image);

}  // namespace vorpipe::core
