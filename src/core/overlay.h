/// What is drawn over the cells of a finished picture, the same for every backend.
#pragma once

#include "vorpipe.h"

namespace vorpipe {

/// Darkens each pixel whose right or lower neighbor belongs to another cell.
void drawEdges(Image& image);

/// Draws a dot at each site inside the domain; its size follows the mean spacing of the sites.
void drawSites(Image& image, const Sites& sites, const Box& domain);

}  // namespace vorpipe
