/// Overlays on a finished picture, the same for every backend. Pixels without a site do not change.
#pragma once

#include <span>

#include "vorpipe.h"
#include "vorpipe/shapes.h"

namespace vorpipe::core {

/// Maps pixels of an image to samples of a picture: the picture's own pixels, or several rows and columns of
/// samples in each.
struct SampleGrid {
  double left = 0, top = 0;  ///< where the image begins, in pixels of the picture
  int in_pixel = 1;          ///< rows and columns of samples in a pixel

  [[nodiscard]] double x(int column) const { return left + (column + 0.5) / in_pixel; }
  [[nodiscard]] double y(int row) const { return top + (row + 0.5) / in_pixel; }
};

/// Colors the samples that have a site and are at most half of `width` pixels from one of the lines.
void drawLines(std::span<const Line> lines, double width, std::uint32_t color, const SampleGrid& samples,
               int threads, Image& image);

/// Blends a color, which may be translucent, over the pixels that lines cover, smoothed: once, however many
/// lines meet.
void blendLines(std::span<const Line> lines, double width, std::uint32_t color, int threads, Image& image);

/// Colors each pixel whose right or lower neighbor belongs to another cell, and each beside a pixel without
/// a site: these are edge pixels. The width is rounded to whole pixels. An odd width above 1 colors all
/// pixels whose centers are within (width - 1) / 2 of an edge pixel's center. An even width colors those
/// within width / 2 of its lower right corner.
void drawEdges(Image& image, double width, std::uint32_t color, int threads);

/// Draws a dot at each site that lies in a pixel with a site.
class SiteDots {
 public:
  /// `image` is the picture, whose ids are indices of `sites`; other marks in it may change. `size` is the
  /// diameter of dots in pixels; 0: about a quarter of the spacing of visible sites with visible cells. All
  /// of it outlives this.
  SiteDots(const Image& image, const Sites& sites, const Box& domain, double size);

  void draw(const SampleGrid& samples, std::uint32_t color, Image& image) const;

 private:
  /// The pixel of a site, y downward, and whether a dot is drawn there.
  [[nodiscard]] double x(std::size_t i) const;
  [[nodiscard]] double y(std::size_t i) const;
  [[nodiscard]] bool shows(std::size_t i) const;
  [[nodiscard]] double spacing() const;

  const Image& picture_;
  const Sites& sites_;
  Box domain_;
  DotSize dot_;
};

}  // namespace vorpipe::core
