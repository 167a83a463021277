#include "picture/smooth.h"

#include <algorithm>
#include <array>

#include "base/parallel.h"
#include "picture/blend.h"

namespace vorpipe::core {
namespace {

/// Returns the mean color of the places of a pixel (decision D106). Places without a site are transparent and
/// do not affect the color.
std::uint32_t meanOf(const Image& places, int row, int column, int in_pixel) {
  constexpr std::uint32_t opaque = 0xFF;
  std::array<std::uint32_t, 3> sums{};
  std::uint32_t covered = 0;
  for (int y = row * in_pixel; y < (row + 1) * in_pixel; ++y) {
    for (int x = column * in_pixel; x < (column + 1) * in_pixel; ++x) {
      const auto at = pixelAt(places, y, x);
      if (places.ids[at] == no_site) continue;
      ++covered;
      const std::uint32_t color = places.rgba[at];
      for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += color >> 8 * c & opaque;
    }
  }
  if (covered == 0) return 0;
  const auto all = static_cast<std::uint32_t>(in_pixel * in_pixel);
  std::uint32_t mean = (opaque * covered + all / 2) / all << 24;
  for (std::size_t c = 0; c < sums.size(); ++c) mean |= (sums[c] + covered / 2) / covered << 8 * c;
  return mean;
}

}  // namespace

Result<void> smooth(const DrawPlaces& draw, int in_pixel, int threads, Image& image) {
  const int step = rowsAtOnce(image.width, in_pixel);
  for (int first = 0; first < image.height; first += step) {
    const int last = std::min(image.height, first + step);
    const auto places = draw(first, last);
    if (!places) return tl::unexpected(places.error());
    constexpr std::size_t grain = 16;
    parallelFor(static_cast<std::size_t>(last - first), grain, threadsForSteps(places->ids.size(), threads),
                [&](std::size_t begin, std::size_t end) {
                  for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
                    for (int column = 0; column < image.width; ++column) {
                      image.rgba[pixelAt(image, first + row, column)] =
                          meanOf(*places, row, column, in_pixel);
                    }
                  }
                });
  }
  return {};
}

}  // namespace vorpipe::core
