#include "motion/start_weights.h"

#include <algorithm>
#include <numbers>

#include "base/block_sums.h"
#include "motion/movable.h"

namespace vorpipe::moving {
namespace {

struct Interval {
  double low, high;
  [[nodiscard]] double middle() const { return low + (high - low) / 2; }
  [[nodiscard]] double length() const { return high - low; }
};

Interval intervalOf(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax_element(values);
  return {*low, *high};
}

/// Adds the contribution of one axis to the weights. With z the coordinate from the middle of `to`, and s(z -
/// m) its target place there, the weight is z^2 minus twice the integral of that place.
void addAxis(const std::vector<double>& coordinates, Interval to, std::vector<double>& weights) {
  const Interval from = intervalOf(coordinates);
  // Places at the wall would leave those sites a line of no area, if they had no neighbors.
  constexpr double inside = 0.999;
  const double scale = from.length() > 0 ? inside * to.length() / from.length() : 1;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const double z = coordinates[i] - to.middle(), offset = coordinates[i] - from.middle();
    weights[i] += z * z - scale * offset * offset;
  }
}

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

std::vector<double> spreadWeights(const Sites& sites, const Box& into, Periodic periodic) {
  std::vector<double> weights(sites.size());
  if (!repeats(periodic).x) addAxis(sites.x, {into.xmin, into.xmax}, weights);
  if (!repeats(periodic).y) addAxis(sites.y, {into.ymin, into.ymax}, weights);
  return weights;
}

bool fillDomain(const Sites& sites, const Box& domain, Periodic periodic) {
  const auto fill = [](Interval sites_range, Interval whole) {
    constexpr double most_beside = 0.2;
    const double slack = most_beside * whole.length();
    return sites_range.low >= whole.low && sites_range.high <= whole.high &&
           sites_range.low <= whole.low + slack && sites_range.high >= whole.high - slack;
  };
  return (repeats(periodic).x || fill(intervalOf(sites.x), {domain.xmin, domain.xmax})) &&
         (repeats(periodic).y || fill(intervalOf(sites.y), {domain.ymin, domain.ymax}));
}

void centerWeights(std::vector<double>& weights, int threads) {
  const double sum = carefulSum(weights.size(), threads, [&](std::size_t i) { return weights[i]; });
  const double mean = sum / static_cast<double>(weights.size());
  forAll(weights.size(), threads, [&](std::size_t i) { weights[i] -= mean; });
}

std::vector<double> discWeights(std::span<const double> masses) {
  std::vector<double> weights(masses.size());
  std::ranges::transform(masses, weights.begin(), [](double mass) { return mass / std::numbers::pi; });
  return weights;
}

Box boxWithMass(const CellsOptions& options) {
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
