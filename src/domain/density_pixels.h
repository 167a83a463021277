/// Positions and values of the pixels of a density, and their integrals along segments.
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
  std::int64_t beyond;  ///< 1 if the region beyond each end is a pixel of its own, else 0

  [[nodiscard]] double pixelsTo(double place) const { return (place - low) / size; }
  /// The pixel at a distance of `pixels` pixels from the lower end. Unless the axis repeats, places beyond
  /// its ends count as in the first or last pixel.
  [[nodiscard]] std::int64_t at(double pixels) const {
    // Far beyond a box, the number of pixels may overflow an integer.
    constexpr double most = 0x1p62;
    const auto pixel = static_cast<std::int64_t>(std::floor(std::clamp(pixels, -most, most)));
    return periodic ? pixel : std::clamp<std::int64_t>(pixel, -beyond, count - 1 + beyond);
  }
  /// Whether `pixel` is a pixel of the density, or an image of one.
  [[nodiscard]] bool has(std::int64_t pixel) const { return beyond == 0 || (pixel >= 0 && pixel < count); }
  /// The index of the density's pixel that represents a pixel with any number that the axis has.
  [[nodiscard]] std::size_t own(std::int64_t pixel) const {
    if (pixel >= 0 && pixel < count) return static_cast<std::size_t>(pixel);
    if (!periodic) return static_cast<std::size_t>(std::clamp<std::int64_t>(pixel, 0, count - 1));
    const std::int64_t rest = pixel % count;
    return static_cast<std::size_t>(rest < 0 ? rest + count : rest);
  }
};

/// A density over a domain, repeated along its periodic axes, or in its own box. The density outlives this
/// object.
class DensityPixels {
 public:
  DensityPixels(const Density& density, const Box& domain, Periodic periodic)
      : DensityPixels(density, density.box.value_or(domain), periodic, density.box ? 1 : 0) {}

  const PixelAxis x, y;

  /// The value of a pixel. Rows of the density count from the top, `row` from the bottom.
  [[nodiscard]] double at(std::int64_t row, std::int64_t column) const {
    if (!y.has(row) || !x.has(column)) return 0;
    const std::size_t from_top = static_cast<std::size_t>(y.count) - 1 - y.own(row);
    return values_[from_top * static_cast<std::size_t>(x.count) + x.own(column)];
  }

 private:
  DensityPixels(const Density& density, const Box& box, Periodic periodic, std::int64_t beyond)
      : x{box.xmin, (box.xmax - box.xmin) / density.width, density.width,
          periodic == Periodic::x || periodic == Periodic::xy, beyond},
        y{box.ymin, (box.ymax - box.ymin) / density.height, density.height,
          periodic == Periodic::y || periodic == Periodic::xy, beyond},
        values_(density.values.data()) {}

  const double* values_;
};

struct SegmentDensity {
  double mean = 0;     ///< its integral divided by the length
  double center = .5;  ///< position of the center of mass, as a fraction of the segment
};

/// Integrates the density over each pixel that the segment from a to b, in the caller's units, crosses. Along
/// the line between two pixels it takes the mean of both: masses have two one-sided derivatives there. From b
/// to a the mean is bitwise the same.
SegmentDensity densityAlong(const DensityPixels& pixels, Point a, Point b);

}  // namespace vorpipe::core
