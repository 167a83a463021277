/// The exact search's pictures: the site nearest to each pixel's center.
#pragma once

#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/cpu/nearest_site.h"

namespace vorpipe::cpu {

/// The pixel centers of a view, relative to its corner.
class PixelCenters {
 public:
  explicit PixelCenters(const View& view)
      : view_(view),
        width_(view.box.xmax - view.box.xmin),
        height_(view.box.ymax - view.box.ymin),
        columns_(static_cast<std::size_t>(view.width)) {}

  /// Returns the center of a pixel by its number, row by row.
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

/// Writes the index in the set of the nearest site for every pixel center of the view; row 0 is
/// the bottom.
void nearestSites(const NearestSite& nearest, const View& view, int threads, std::span<std::uint32_t> out);

/// The same for some of the pixels, numbered row by row.
void nearestSites(const NearestSite& nearest, const View& view, std::span<const std::uint32_t> pixels,
                  int threads, std::span<std::uint32_t> out);

}  // namespace vorpipe::cpu
