#include "sites/near_sites.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t near_sites_grain = std::size_t{1} << 16;
/// From this size on, two different doubles are farther apart than the least distance.
constexpr double told_apart = least_distance * 0x1p54;

using Pair = std::pair<std::uint32_t, std::uint32_t>;

bool isSmall(double value) { return std::abs(value) < told_apart; }

/// Whether any coordinate is small and not 0. Two sites near each other have such a coordinate.
bool anySmall(const SiteSet& set, int threads) {
  std::atomic<bool> any = false;
  parallelFor(set.size(), near_sites_grain, threads, [&](std::size_t begin, std::size_t end) {
    bool here = false;
    for (auto i = begin; i < end; ++i) {
      here = here || (isSmall(set.x[i]) && set.x[i] != 0) || (isSmall(set.y[i]) && set.y[i] != 0);
    }
    if (here) any = true;
  });
  return any;
}

/// Searches `sites` in rows of the plane, which are as high as the least distance and shifted by a part of
/// that.
std::optional<Pair> nearInRows(const SiteSet& set, std::vector<std::uint32_t>& sites, double shift) {
  const auto row = [&](std::uint32_t i) { return std::floor(set.y[i] / least_distance + shift); };
  std::sort(sites.begin(), sites.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(row(a), set.x[a]) < std::pair(row(b), set.x[b]);
  });
  for (std::size_t k = 1; k < sites.size(); ++k) {
    const auto a = sites[k - 1], b = sites[k];
    if (row(a) == row(b) && set.x[b] - set.x[a] < least_distance) return Pair{std::min(a, b), std::max(a, b)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Pair> tooNear(const SiteSet& set, int threads) {
  if (!anySmall(set, threads)) return std::nullopt;
  std::vector<std::uint32_t> sites;
  for (std::uint32_t i = 0; i < set.size(); ++i) {
    if (isSmall(set.x[i]) || isSmall(set.y[i])) sites.push_back(i);
  }
  // Sites on both sides of a border between rows share one of the shifted rows.
  auto pair = nearInRows(set, sites, 0);
  return pair ? pair : nearInRows(set, sites, 0.5);
}

}  // namespace vorpipe::core
