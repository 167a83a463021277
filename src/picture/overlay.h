/// Overlays on a finished picture, the same for every backend. Pixels without a site do not change.
#pragma once

#include "picture/strokes.h"

namespace vorpipe::core {

/// Darkens each pixel whose right or lower neighbor belongs to another cell, and each beside a pixel without
/// a site: these are edge pixels. The width is rounded to whole pixels. An odd width above 1 darkens all
/// pixels whose centers are within (width - 1) / 2 of an edge pixel's center. An even width darkens those
/// within width / 2 of its lower right corner.
void drawEdges(Image& image, double width, int threads);

/// Draws a dot at each site that lies in a pixel with a site.
class SiteDots {
 public:
  /// `image` is the picture, whose ids are indices of `sites`; other marks in it may change. `size` is the
  /// diameter of dots in pixels; 0: about a quarter of the spacing of visible sites with visible cells. All
  /// of it outlives this.
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
