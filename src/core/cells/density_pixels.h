/// Where the pixels of a density lie, and what they have.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "vorpipe.h"

namespace vorpipe::core {

/// The pixels along one axis.
struct PixelAxis {
  double low, size;  ///< of the first pixel, in the caller's units
  std::int64_t count;
  bool periodic;

  [[nodiscard]] double pixelsTo(double place) const { return (place - low) / size; }
  /// The pixel at a place that lies that many pixels from the lower end. Where the axis does not repeat, what
  /// lies beyond its ends counts as in the first or last pixel.
  [[nodiscard]] std::int64_t at(double pixels) const {
    const auto pixel = static_cast<std::int64_t>(std::floor(pixels));
    return periodic ? pixel : clamped(pixel);
  }
  /// The pixel that stands for one of any number.
  [[nodiscard]] std::size_t own(std::int64_t pixel) const {
    if (pixel >= 0 && pixel < count) return static_cast<std::size_t>(pixel);
    if (!periodic) return static_cast<std::size_t>(clamped(pixel));
    const std::int64_t rest = pixel % count;
    return static_cast<std::size_t>(rest < 0 ? rest + count : rest);
  }

 private:
  [[nodiscard]] std::int64_t clamped(std::int64_t pixel) const {
    return std::clamp<std::int64_t>(pixel, 0, count - 1);
  }
};

/// A density over a domain, repeated along its periodic axes. The density outlives this.
class DensityPixels {
 public:
  DensityPixels(const Density& density, const Box& domain, Periodic periodic)
      : x{domain.xmin, (domain.xmax - domain.xmin) / density.width, density.width,
          periodic == Periodic::x || periodic == Periodic::xy},
        y{domain.ymin, (domain.ymax - domain.ymin) / density.height, density.height,
          periodic == Periodic::y || periodic == Periodic::xy},
        values_(density.values.data()) {}

  const PixelAxis x, y;

  /// Rows of the density count from the top, those here from the bottom.
  [[nodiscard]] double at(std::int64_t row, std::int64_t column) const {
    const std::size_t from_top = static_cast<std::size_t>(y.count) - 1 - y.own(row);
    return values_[from_top * static_cast<std::size_t>(x.count) + x.own(column)];
  }

 private:
  const double* values_;
};

}  // namespace vorpipe::core
