#include "sites/weights.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "base/double_double.h"
#include "base/parallel.h"
#include "base/refusal.h"
#include "sites/site_set.h"
#include "sites/weight_pyramid.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t weights_grain = 1 << 16;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double heaviest_usable = 0x1p600;  ///< in squares of domains
/// Weights nearer to 0 become 0, as coordinates do: exact decisions multiply them by two coordinate
/// differences.
constexpr double least_weight = least_coordinate * least_coordinate;

bool isUsable(double weight) { return std::abs(weight) <= heaviest_usable; }

struct Range {
  double least = infinite, most = -infinite;
  bool usable = true;

  void add(const Range& other) {
    least = std::min(least, other.least);
    most = std::max(most, other.most);
    usable = usable && other.usable;
  }
};

Range rangeOf(const std::vector<double>& weights, int threads) {
  std::vector<Range> ranges((weights.size() + weights_grain - 1) / weights_grain);
  parallelFor(weights.size(), weights_grain, threads, [&](std::size_t begin, std::size_t end) {
    Range range;
    for (auto i = begin; i < end; ++i) range.add({weights[i], weights[i], isUsable(weights[i])});
    ranges[begin / weights_grain] = range;
  });
  Range all;
  for (const auto& range : ranges) all.add(range);
  return all;
}

/// The error of the first weight that is not usable; there is one.
Error unusableWeight(const Sites& sites, const std::vector<double>& scaled) {
  const auto first = std::find_if_not(scaled.begin(), scaled.end(), isUsable) - scaled.begin();
  const double weight = sites.weight[static_cast<std::size_t>(first)];
  return refusal(Subject::weights,
                 fmt::format("the weight of site {} is {}: {}", first,
                             std::isfinite(weight) ? "too large for the domain" : "not finite", weight));
}

void subtractIfExact(double least, int threads, std::vector<double>& weights) {
  std::atomic<bool> exact = true;
  parallelFor(weights.size(), weights_grain, threads, [&](std::size_t begin, std::size_t end) {
    bool all = true;
    for (auto i = begin; i < end; ++i) all = all && DoubleDouble::sum(weights[i], -least).low == 0;
    if (!all) exact = false;
  });
  if (!exact) return;
  parallelFor(weights.size(), weights_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) weights[i] -= least;
  });
}

void dropTinyWeights(int threads, std::vector<double>& weights) {
  parallelFor(weights.size(), weights_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      if (std::abs(weights[i]) < least_weight) weights[i] = 0;
    }
  });
}

/// A site that is heavier by e than all others, in bins of size s, makes about e / s^2 cells around it search
/// e / s^2 bins each, (e / s^2)^2 in all. Trying it for every cell costs one step per site, n in all. The
/// break-even is e / s^2 = sqrt(n).
void findHeavy(SiteSet& set) {
  std::vector<std::uint32_t> all(set.size()), top(std::min(set.size(), most_heavy + 1));
  std::iota(all.begin(), all.end(), 0u);
  std::partial_sort_copy(all.begin(), all.end(), top.begin(), top.end(), [&](auto a, auto b) {
    return set.weight[a] != set.weight[b] ? set.weight[a] > set.weight[b] : set.id[a] < set.id[b];
  });
  const double least =
      set.weight[top.back()] + set.grid.size * set.grid.size * std::sqrt(static_cast<double>(set.size()));
  const auto end =
      std::find_if_not(top.begin(), top.end(), [&](auto site) { return set.weight[site] > least; });
  set.heavy.assign(top.begin(), end);
}

}  // namespace

bool hasWeights(const Sites& sites) {
  const auto& weight = sites.weight;
  return std::adjacent_find(weight.begin(), weight.end(), std::not_equal_to<>()) != weight.end();
}

Result<std::vector<double>> scaledWeights(const Sites& sites, int exponent, int threads) {
  std::vector<double> weights(sites.weight.size());
  parallelFor(weights.size(), weights_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) weights[i] = std::ldexp(sites.weight[i], 2 * exponent);
  });
  const auto range = rangeOf(weights, threads);
  if (!range.usable) return tl::unexpected(unusableWeight(sites, weights));
  if (!(range.least < range.most)) return std::vector<double>{};
  subtractIfExact(range.least, threads, weights);
  dropTinyWeights(threads, weights);
  return weights;
}

void giveWeights(const std::vector<double>& by_input, int threads, SiteSet& set) {
  if (by_input.empty()) return;
  set.weight.resize(set.size());
  parallelFor(set.size(), weights_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) set.weight[i] = by_input[set.id[i]];
  });
  const auto range = rangeOf(set.weight, threads);
  if (!(range.least < range.most)) {
    set.weight.clear();
    return;
  }
  findHeavy(set);
  noteHeaviest(set, threads);
  buildPyramid(set.grid);
}

}  // namespace vorpipe::core
