#include "motion/roomy_box.h"

#include <algorithm>
#include <vector>

#include "motion/allowed_places.h"

namespace vorpipe::moving {
namespace {

constexpr int samples = 128;

/// Samples at the middles of samples x samples boxes of the domain.
class Samples {
 public:
  explicit Samples(const CellsOptions& options)
      : options_(options), allowed_(options.domain, options.outline, options.periodic) {}

  [[nodiscard]] bool hasMass(int column, int row) const {
    const Box& box = options_.domain;
    const double x = (column + 0.5) / samples, y = (row + 0.5) / samples;
    const Point place{box.xmin + x * (box.xmax - box.xmin), box.ymin + y * (box.ymax - box.ymin)};
    if (!allowed_.contain(place)) return false;
    const Density& density = options_.density;
    if (density.values.empty()) return true;
    const Box& pixels = density.box ? *density.box : box;
    const double along_x = density.box ? (place.x - pixels.xmin) / (pixels.xmax - pixels.xmin) : x;
    const double along_y = density.box ? (place.y - pixels.ymin) / (pixels.ymax - pixels.ymin) : y;
    if (!(along_x >= 0 && along_x < 1 && along_y > 0 && along_y <= 1)) return false;
    const int across = static_cast<int>(along_x * density.width);
    const int from_top = std::min(static_cast<int>((1 - along_y) * density.height), density.height - 1);
    const auto pixel = static_cast<std::size_t>(from_top) * static_cast<std::size_t>(density.width) +
                       static_cast<std::size_t>(across);
    return density.values[pixel] > 0;
  }

  /// Returns the box from the middle of the sample at (column, row) to the middle of that `side` - 1 columns
  /// and rows before it.
  [[nodiscard]] Box endingAt(int column, int row, int side) const {
    const Box& box = options_.domain;
    const double width = (box.xmax - box.xmin) / samples, height = (box.ymax - box.ymin) / samples;
    // For a single sample, a part of its own box.
    const double before = side > 1 ? side - 1 : 0.25, after = side > 1 ? 0 : 0.25;
    return {box.xmin + (column + 0.5 - before) * width, box.ymin + (row + 0.5 - before) * height,
            box.xmin + (column + 0.5 + after) * width, box.ymin + (row + 0.5 + after) * height};
  }

 private:
  const CellsOptions& options_;
  AllowedPlaces allowed_;
};

}  // namespace

Box roomyBox(const CellsOptions& options) {
  const Samples all(options);
  // sides[c]: side of the largest square of samples with mass that ends at column c and the current row.
  std::vector<int> sides(samples), above(samples);
  int best = 0;
  Box found = options.domain;
  for (int row = 0; row < samples; ++row) {
    above.swap(sides);
    for (int column = 0; column < samples; ++column) {
      const auto c = static_cast<std::size_t>(column);
      const int before = column > 0 ? std::min({sides[c - 1], above[c - 1], above[c]}) : 0;
      sides[c] = all.hasMass(column, row) ? before + 1 : 0;
      if (sides[c] <= best) continue;
      best = sides[c];
      found = all.endingAt(column, row, best);
    }
  }
  return found;
}

}  // namespace vorpipe::moving
