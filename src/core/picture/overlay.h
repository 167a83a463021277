/// What is drawn over the cells of a finished picture, the same for every backend. Pixels without a site stay
/// as they are.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

/// Darkens each pixel whose right or lower neighbor belongs to another cell, and each beside one without a
/// site: these are edge pixels. The width is rounded to whole pixels. An odd one of more than 1 darkens all
/// pixels whose centers are within (width - 1) / 2 of that of an edge pixel, an even one those within width /
/// 2 of its lower right corner.
void drawEdges(Image& image, double width, int threads);

/// Draws a dot at each site in a pixel that has a site. `size` is its diameter in pixels; 0: about a quarter
/// of the spacing of those sites that show, and whose cells do. Ids of the image are indices of `sites`.
void drawSites(Image& image, const Sites& sites, const Box& domain, double size);

}  // namespace vorpipe::core
