#include "cells/likely_empty.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/inside.h"
#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t runs = 512;

/// The largest distance by which a bisector of a site with its next few sites, before or after it, lies
/// behind the site.
class Depths {
 public:
  explicit Depths(const SiteSet& sites) : sites_(sites) {}

  [[nodiscard]] double operator()(std::size_t i) const {
    double deepest = -std::numeric_limits<double>::infinity();
    const auto last = std::min(i + few, sites_.size() - 1);
    for (auto j = i > few ? i - few : 0; j <= last; ++j) {
      if (j != i) deepest = std::max(deepest, behind(i, j));
    }
    return deepest;
  }

 private:
  static constexpr std::size_t few = 2;

  [[nodiscard]] double behind(std::size_t i, std::size_t j) const {
    const double dx = sites_.x[j] - sites_.x[i], dy = sites_.y[j] - sites_.y[i];
    const double squared = dx * dx + dy * dy;
    return (sites_.weight[j] - sites_.weight[i] - squared) / std::sqrt(squared);
  }

  const SiteSet& sites_;
};

}  // namespace

std::vector<std::uint32_t> likelyEmpty(const SiteSet& sites, int threads) {
  if (sites.weight.empty()) return {};
  const std::size_t length = (sites.size() + runs - 1) / runs;
  std::vector<std::uint32_t> likely((sites.size() + length - 1) / length);
  std::vector<double> depth(likely.size(), -std::numeric_limits<double>::infinity());
  const Depths depths(sites);
  parallelFor(sites.size(), length, threadsForSteps(sites.size(), threads),
              [&](std::size_t begin, std::size_t end) {
                const auto run = begin / length;
                for (auto i = begin; i < end; ++i) {
                  if (!isInside(sites.domain, sites.x[i], sites.y[i])) continue;
                  const double deep = depths(i);
                  if (!(deep > depth[run])) continue;
                  depth[run] = deep;
                  likely[run] = static_cast<std::uint32_t>(i);
                }
              });
  std::size_t kept = 0;
  for (std::size_t run = 0; run < likely.size(); ++run) {
    if (depth[run] > 0) likely[kept++] = likely[run];
  }
  likely.resize(kept);
  return likely;
}

}  // namespace vorpipe::core
