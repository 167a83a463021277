#include "backend/cpu/pixels/picture.h"

#include "base/parallel.h"

namespace vorpipe::cpu {
namespace {

/// Of the pixels of a view, seen from its corner.
class Centers {
 public:
  explicit Centers(const View& view)
      : view_(view),
        width_(view.box.xmax - view.box.xmin),
        height_(view.box.ymax - view.box.ymin),
        columns_(static_cast<std::size_t>(view.width)) {}

  [[nodiscard]] Point at(std::size_t pixel) const {
    const std::size_t row = pixel / columns_, column = pixel % columns_;
    return {view_.box.xmin + (static_cast<double>(column) + 0.5) / view_.width * width_,
            view_.box.ymin + (static_cast<double>(row) + 0.5) / view_.height * height_};
  }

 private:
  const View& view_;
  double width_, height_;
  std::size_t columns_;
};

constexpr std::size_t grain = 1024;

}  // namespace

void nearestSites(const NearestSite& nearest, const View& view, int threads, std::span<std::uint32_t> out) {
  const Centers centers(view);
  parallelFor(out.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      out[pixel] = nearest.at(view.corner, centers.at(pixel));
    }
  });
}

void nearestSites(const NearestSite& nearest, const View& view, std::span<const std::uint32_t> pixels,
                  int threads, std::span<std::uint32_t> out) {
  const Centers centers(view);
  parallelFor(pixels.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) out[k] = nearest.at(view.corner, centers.at(pixels[k]));
  });
}

}  // namespace vorpipe::cpu
