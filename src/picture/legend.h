/// The legend of a picture.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

/// Pixels in a unit of the font: texts have about the same share of every picture.
int legendUnit(PictureSize picture);

/// Draws boxes and texts over the colors of a picture; its ids do not change.
void drawLegend(const Legend& legend, Image& image);

}  // namespace vorpipe::core
