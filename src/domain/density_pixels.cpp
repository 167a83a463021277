#include "domain/density_pixels.h"

#include <limits>
#include <utility>

namespace vorpipe::core {
namespace {

/// The tolerance, in pixels, for a segment to lie on a line between pixels: the rounding error with a
/// thousand pixels or more.
constexpr double on_line = 1e-10;

/// A segment along one axis: the pixels that it crosses, one after the other.
class AxisWalk {
 public:
  AxisWalk(const PixelAxis& axis, double from, double to)
      : from_(axis.pixelsTo(from)), way_(axis.pixelsTo(to) - from_) {
    const double line = std::nearbyint(from_);
    pixel_ = axis.at(from_);
    last_ = axis.at(from_ + way_);
    if (std::abs(from_ - line) < on_line && std::abs(from_ + way_ - line) < on_line) {
      pixel_ = last_ = static_cast<std::int64_t>(line);
      beside_ = -1;
    }
  }

  [[nodiscard]] std::int64_t pixel() const { return pixel_; }
  /// Offset of the other pixel if the segment runs along a line; else 0.
  [[nodiscard]] int beside() const { return beside_; }
  /// The fraction of the segment at which it leaves the pixel.
  [[nodiscard]] double end() const {
    if (pixel_ == last_) return std::numeric_limits<double>::infinity();
    return (static_cast<double>(pixel_ < last_ ? pixel_ + 1 : pixel_) - from_) / way_;
  }
  void step() { pixel_ += pixel_ < last_ ? 1 : -1; }

 private:
  double from_, way_;
  std::int64_t pixel_ = 0, last_ = 0;
  int beside_ = 0;
};

double valueAt(const DensityPixels& pixels, const AxisWalk& x, const AxisWalk& y) {
  const double value = pixels.at(y.pixel(), x.pixel());
  if (x.beside() == 0 && y.beside() == 0) return value;
  return (value + pixels.at(y.pixel(), x.pixel() + x.beside()) +
          pixels.at(y.pixel() + y.beside(), x.pixel()) +
          pixels.at(y.pixel() + y.beside(), x.pixel() + x.beside())) /
         4;
}

SegmentDensity walk(const DensityPixels& pixels, Point a, Point b) {
  AxisWalk x(pixels.x, a.x, b.x), y(pixels.y, a.y, b.y);
  double begin = 0, sum = 0, moment = 0;
  while (begin < 1) {
    const double to_x = x.end(), to_y = y.end();
    const double end = std::clamp(std::min(to_x, to_y), begin, 1.0);
    const double mass = (end - begin) * valueAt(pixels, x, y);
    sum += mass;
    moment += mass * ((begin + end) / 2);
    if (!(std::min(to_x, to_y) < 1)) break;
    (to_x < to_y ? x : y).step();
    begin = end;
  }
  return {sum, sum > 0 ? moment / sum : 0.5};
}

}  // namespace

SegmentDensity densityAlong(const DensityPixels& pixels, Point a, Point b) {
  if (b.x > a.x || (b.x == a.x && b.y >= a.y)) return walk(pixels, a, b);
  const SegmentDensity back = walk(pixels, b, a);
  return {back.mean, 1 - back.center};
}

}  // namespace vorpipe::core
