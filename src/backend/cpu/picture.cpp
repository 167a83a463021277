#include "backend/cpu/picture.h"

#include "base/parallel.h"

namespace vorpipe::cpu {
namespace {

constexpr std::size_t picture_grain = 1024;

double pixelWidth(const View& view) { return (view.box.xmax - view.box.xmin) / view.width; }

}  // namespace

void nearestSites(const NearestSite& nearest, const View& view, int threads, std::span<std::uint32_t> out) {
  const PixelCenters centers(view);
  parallelFor(out.size(), picture_grain, threads, [&](std::size_t begin, std::size_t end) {
    NearestSite::Walk walk(nearest, pixelWidth(view));
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      out[pixel] = walk.at(view.corner, centers.at(pixel));
    }
  });
}

void nearestSites(const NearestSite& nearest, const View& view, std::span<const std::uint32_t> pixels,
                  int threads, std::span<std::uint32_t> out) {
  const PixelCenters centers(view);
  parallelFor(pixels.size(), picture_grain, threads, [&](std::size_t begin, std::size_t end) {
    NearestSite::Walk walk(nearest, pixelWidth(view));
    for (std::size_t k = begin; k < end; ++k) out[k] = walk.at(view.corner, centers.at(pixels[k]));
  });
}

}  // namespace vorpipe::cpu
