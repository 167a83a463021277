#include "core/picture/overlay.h"

#include <algorithm>
#include <cmath>

namespace vorpipe::core {
namespace {

constexpr std::uint32_t edge_color = 0xFF181818u;
constexpr std::uint32_t dot_color = 0xFFFFFFFFu;
constexpr std::uint32_t rim_color = 0xFF000000u;

std::size_t pixelAt(const Image& image, int row, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
         static_cast<std::size_t>(column);
}

void drawDot(Image& image, double x, double y, double radius) {
  const int reach = static_cast<int>(std::ceil(radius));
  const int center_column = static_cast<int>(std::floor(x));
  const int center_row = static_cast<int>(std::floor(y));
  for (int row = std::max(0, center_row - reach); row <= std::min(image.height - 1, center_row + reach);
       ++row) {
    for (int column = std::max(0, center_column - reach);
         column <= std::min(image.width - 1, center_column + reach); ++column) {
      const double distance = std::hypot(column + 0.5 - x, row + 0.5 - y);
      const auto pixel = pixelAt(image, row, column);
      if (distance > radius || image.ids[pixel] == no_site) continue;
      image.rgba[pixel] = distance > radius - 1 ? rim_color : dot_color;
    }
  }
}

}  // namespace

void drawEdges(Image& image) {
  // Where the cell ends at the outline on its left or upper side, its own pixel is darkened.
  const auto compare = [&](std::size_t here, std::size_t next) {
    if (image.ids[here] == image.ids[next]) return;
    image.rgba[image.ids[here] != no_site ? here : next] = edge_color;
  };
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const auto here = pixelAt(image, row, column);
      if (column + 1 < image.width) compare(here, pixelAt(image, row, column + 1));
      if (row + 1 < image.height) compare(here, pixelAt(image, row + 1, column));
    }
  }
}

void drawSites(Image& image, const Sites& sites, std::size_t count, const Box& domain) {
  const double pixels = static_cast<double>(image.width) * image.height;
  const double spacing = std::sqrt(pixels / static_cast<double>(count));
  const double radius = std::clamp(0.12 * spacing, 1.0, 5.0);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double x = (sites.x[i] - domain.xmin) / (domain.xmax - domain.xmin) * image.width;
    const double y = (domain.ymax - sites.y[i]) / (domain.ymax - domain.ymin) * image.height;
    if (!(x >= 0 && x < image.width && y >= 0 && y < image.height)) continue;
    const auto pixel = pixelAt(image, static_cast<int>(y), static_cast<int>(x));
    if (image.ids[pixel] != no_site) drawDot(image, x, y, radius);
  }
}

}  // namespace vorpipe::core
