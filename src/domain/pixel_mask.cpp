#include "domain/pixel_mask.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace vorpipe::core {
namespace {

/// Number of rows that one thread masks at a time.
constexpr int band_rows = 32;

/// The centers of an image's pixels, in the domain scaled by a power of two.
class Centers {
 public:
  Centers(const Box& domain, const Image& image, int exponent)
      : width_(image.width), height_(image.height), exponent_(exponent), domain_(domain) {}

  [[nodiscard]] double x(int column) const {
    return std::ldexp(domain_.xmin + (column + 0.5) / width_ * (domain_.xmax - domain_.xmin), exponent_);
  }
  [[nodiscard]] double y(int row) const {
    return std::ldexp(domain_.ymax - (row + 0.5) / height_ * (domain_.ymax - domain_.ymin), exponent_);
  }
  /// About the number of columns whose centers lie left of x.
  [[nodiscard]] int columnsLeftOf(double place) const {
    return near((std::ldexp(place, -exponent_) - domain_.xmin) / (domain_.xmax - domain_.xmin) * width_,
                width_);
  }
  [[nodiscard]] int rowsAbove(double place) const {
    return near((domain_.ymax - std::ldexp(place, -exponent_)) / (domain_.ymax - domain_.ymin) * height_,
                height_);
  }

 private:
  static int near(double count, int most) {
    return static_cast<int>(std::clamp(std::floor(count + 0.5), 0.0, static_cast<double>(most)));
  }
  int width_, height_, exponent_;
  Box domain_;
};

/// For each band of rows, the edges that may cross one of them.
struct Bands {
  std::vector<std::uint64_t> offsets;
  std::vector<std::uint32_t> edges;
};

Bands bandsOf(const Rings& rings, const Centers& centers, int height) {
  const int count = (height + band_rows - 1) / band_rows;
  const auto eachBand = [&](std::uint32_t e, const auto& take) {
    const Point p = rings.points[e], q = rings.endOf(e);
    // One more row on either side allows for rounding of the estimate.
    const int top = std::max(0, centers.rowsAbove(std::max(p.y, q.y)) - 1);
    const int bottom = std::min(height - 1, centers.rowsAbove(std::min(p.y, q.y)) + 1);
    for (int band = top / band_rows; band <= bottom / band_rows; ++band) take(static_cast<std::size_t>(band));
  };
  Bands bands;
  bands.offsets.assign(static_cast<std::size_t>(count) + 2, 0);
  for (std::uint32_t e = 0; e < rings.size(); ++e) {
    eachBand(e, [&](std::size_t band) { ++bands.offsets[band + 2]; });
  }
  for (std::size_t b = 2; b < bands.offsets.size(); ++b) bands.offsets[b] += bands.offsets[b - 1];
  bands.edges.resize(bands.offsets.back());
  for (std::uint32_t e = 0; e < rings.size(); ++e) {
    eachBand(e, [&](std::size_t band) { bands.edges[bands.offsets[band + 1]++] = e; });
  }
  bands.offsets.pop_back();
  return bands;
}

/// Number of centers of a row that lie left of an edge that crosses it.
int columnsLeftOf(Point p, Point q, const Centers& centers, double y, int width) {
  const double along = (y - p.y) / (q.y - p.y);
  int column = centers.columnsLeftOf(p.x + along * (q.x - p.x));
  while (column < width && crossesRay(p, q, {centers.x(column), y})) ++column;
  while (column > 0 && !crossesRay(p, q, {centers.x(column - 1), y})) --column;
  return column;
}

void clearPixels(Image& image, int row, int begin, int end) {
  const auto first = static_cast<std::ptrdiff_t>(row) * image.width;
  std::fill(image.ids.begin() + first + begin, image.ids.begin() + first + end, no_site);
  std::fill(image.rgba.begin() + first + begin, image.rgba.begin() + first + end, 0u);
}

}  // namespace

void maskOutside(const Rings& rings, const Box& domain, int exponent, int threads, Image& image) {
  const Centers centers(domain, image, exponent);
  const Bands bands = bandsOf(rings, centers, image.height);
  parallelFor(bands.offsets.size() - 1, 1, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<int> turns;
    for (auto band = begin; band < end; ++band) {
      const int top = static_cast<int>(band) * band_rows;
      for (int row = top; row < std::min(image.height, top + band_rows); ++row) {
        const double y = centers.y(row);
        turns.clear();
        for (auto k = bands.offsets[band]; k < bands.offsets[band + 1]; ++k) {
          const Point p = rings.points[bands.edges[k]], q = rings.endOf(bands.edges[k]);
          if ((p.y >= y) != (q.y >= y)) turns.push_back(columnsLeftOf(p, q, centers, y, image.width));
        }
        std::ranges::sort(turns);
        turns.push_back(image.width);
        int outside_from = 0;
        for (std::size_t t = 0; t < turns.size(); t += 2) {
          clearPixels(image, row, outside_from, turns[t]);
          outside_from = t + 1 < turns.size() ? turns[t + 1] : image.width;
        }
      }
    }
  });
}

}  // namespace vorpipe::core
