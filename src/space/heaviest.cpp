#include "space/heaviest.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vorpipe::space {

HeaviestOfBlocks::HeaviestOfBlocks(const int (&count)[3], std::span<const std::uint32_t> begin,
                                   std::span<const double> weights) {
  Level bins{{count[0], count[1], count[2]}, std::vector<double>(begin.size() - 1, none)};
  for (std::size_t bin = 0; bin < bins.most.size(); ++bin) {
    for (std::uint32_t site = begin[bin]; site < begin[bin + 1]; ++site)
      bins.most[bin] = std::max(bins.most[bin], weights[site]);
  }
  level_.push_back(std::move(bins));
  while (level_.back().most.size() > 1) {
    const std::size_t below = level_.size() - 1;
    const auto& n = level_[below].count;
    level_.push_back({{(n[0] + 1) / 2, (n[1] + 1) / 2, (n[2] + 1) / 2}, {}});
    const auto& half = level_.back().count;
    level_.back().most.assign(static_cast<std::size_t>(half[0]) * static_cast<std::size_t>(half[1]) *
                                  static_cast<std::size_t>(half[2]),
                              none);
    for (std::size_t k = 0; k < level_[below].most.size(); ++k) {
      const auto [x, y, z] = blockOf(below, k);
      double& most = level_.back().most[indexOf(below + 1, {x / 2, y / 2, z / 2})];
      most = std::max(most, level_[below].most[k]);
    }
  }
}

std::vector<std::uint32_t> heavySites(std::span<const double> weights, double side) {
  constexpr std::size_t most_heavy = 32;
  std::vector<std::uint32_t> all(weights.size()), top(std::min(weights.size(), most_heavy + 1));
  std::iota(all.begin(), all.end(), 0U);
  std::partial_sort_copy(all.begin(), all.end(), top.begin(), top.end(), [&](auto a, auto b) {
    return weights[a] != weights[b] ? weights[a] > weights[b] : a < b;
  });
  // With them cells would look farther by some of these sides, into many bins.
  constexpr double most_sides = 0.3;
  const double least = weights[top.back()] + most_sides * side * side;
  const auto end = std::find_if_not(top.begin(), top.end(), [&](auto site) { return weights[site] > least; });
  top.erase(end, top.end());
  return top;
}

std::vector<float> largestAround(const int (&count)[3], std::vector<float> of_bin, int reach) {
  std::vector<float> around(of_bin.size());
  const auto far = static_cast<std::size_t>(reach);
  std::size_t stride = 1;
  for (const int along : count) {
    const auto n = static_cast<std::size_t>(along);
    for (std::size_t line = 0; line < of_bin.size(); line += n * stride) {
      for (std::size_t at = 0; at < n; ++at) {
        float* const to = around.data() + line + at * stride;
        std::copy_n(of_bin.data() + line + at * stride, stride, to);
        for (std::size_t e = at > far ? at - far : 0; e <= std::min(at + far, n - 1); ++e) {
          const float* const from = of_bin.data() + line + e * stride;
          for (std::size_t k = 0; k < stride; ++k) to[k] = std::max(to[k], from[k]);
        }
      }
    }
    of_bin.swap(around);
    stride *= n;
  }
  return of_bin;
}

}  // namespace vorpipe::space
