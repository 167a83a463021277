#include "motion/start_weights.h"

#include <algorithm>
#include <cmath>
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

}  // namespace vorpipe::moving
