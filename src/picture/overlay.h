/// What is drawn over the cells of a finished picture, the same for every backend. Pixels without a site stay
/// as they are.
#pragma once

#include "picture/strokes.h"

namespace vorpipe::core {

/// Darkens each pixel whose right or lower neighbor belongs to another cell, and each beside one without a
/// site: these are edge pixels. The width is rounded to whole pixels. An odd one of more than 1 darkens all
/// pixels whose centers are within (width - 1) / 2 of that of an edge pixel, an even one those within width /
/// 2 of its lower right corner.
void drawEdges(Image& image, double width, int threads);

/// Draws a dot at each site in a pixel that has a site.
class SiteDots {
 public:
  /// `image` is the picture, whose ids are indices of `sites`; what it has besides dots may change. `size` is
  /// their diameter in pixels; 0: about a quarter of the spacing of those sites that show, and whose cells
  /// do. All of it outlives this.
  SiteDots(const Image& image, const Sites& sites, const Box& domain, double size);

  /// `white_cells`: dots are black, since white ones would not show.
  void draw(const Places& places, bool white_cells, Image& image) const;

 private:
  const Image& picture_;
  const Sites& sites_;
  Box domain_;
  DotSize dot_;
};

}  // namespace vorpipe::core
