/// What is drawn over the cells of a finished picture, the same for every backend. Pixels without a site stay
/// as they are.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

/// Darkens each pixel whose right or lower neighbor belongs to another cell, and each beside one without a
/// site.
void drawEdges(Image& image);

/// Draws a dot at each site in a pixel that has a site; its size follows the mean spacing of `count` sites.
void drawSites(Image& image, const Sites& sites, std::size_t count, const Box& domain);

}  // namespace vorpipe::core
