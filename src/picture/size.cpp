#include <algorithm>
#include <cmath>

#include "vorpipe.h"

namespace vorpipe {

PictureSize sizeFor(const Box& domain, int longer_side) {
  const double width = domain.xmax - domain.xmin, height = domain.ymax - domain.ymin;
  const auto shorter = [&](double part) {
    return std::max(1, static_cast<int>(std::lround(part * longer_side)));
  };
  if (width >= height) return PictureSize{longer_side, shorter(height / width)};
  return PictureSize{shorter(width / height), longer_side};
}

PictureSize defaultSize(const Box& domain) {
  constexpr int default_longer_side = 1000;
  return sizeFor(domain, default_longer_side);
}

PictureFrame frameOf(const Box& domain, int width, int height, Fit fit) {
  const PictureFrame whole{0, 0, width, height};
  if (fit == Fit::stretch) return whole;
  // Per width of the picture and per height of it, so that no extent of a domain overflows.
  const double wide = (domain.xmax - domain.xmin) / width, high = (domain.ymax - domain.ymin) / height;
  const double fitting_width = wide < high ? width * (wide / high) : width;
  const double fitting_height = high < wide ? height * (high / wide) : height;
  // If the width matches the height, rounding to pixels leaves up to a pixel, and rounding of doubles
  // slightly more.
  constexpr double most_left = 1 + 1e-6;
  if (width - fitting_width <= most_left && height - fitting_height <= most_left) return whole;
  const auto pixels = [](double side) { return std::max(1, static_cast<int>(std::lround(side))); };
  const int frame_width = pixels(fitting_width), frame_height = pixels(fitting_height);
  return {(width - frame_width) / 2, (height - frame_height) / 2, frame_width, frame_height};
}

DotSize dotSizeOf(double size, double spacing, PictureSize picture) {
  double radius = size / 2;
  if (size == 0) {
    // Large pictures are viewed from farther away.
    constexpr double part_of_spacing = 0.12, least = 0.5, usual = 5;
    constexpr int sides = 200;
    const double most = std::max<double>(usual, std::max(picture.width, picture.height) / sides);
    radius = std::clamp(part_of_spacing * spacing, least, most);
  }
  // A rim around a smaller dot would leave little of it.
  constexpr double least_with_rim = 2.5, part_of_radius = 0.2;
  return {radius, radius >= least_with_rim ? std::max(1.0, part_of_radius * radius) : 0};
}

}  // namespace vorpipe
