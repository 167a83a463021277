#include "globe/sphere_walk.h"

#include <algorithm>

#include "base/parallel.h"

namespace vorpipe::core {

SphereWalk::SphereWalk(const Sites& sites, const Diagram& diagram, int threads)
    : diagram_(diagram),
      vectors_(sites.size()),
      first_(static_cast<std::uint32_t>(std::ranges::find(diagram.status, Status::ok) -
                                        diagram.status.begin())) {
  constexpr std::size_t grain = 1024;
  parallelEach(sites.size(), grain, threadCount(threads), [&](std::size_t i) {
    const double excess = sites.weight.empty() ? 0 : excessOf(sites.weight[i]);
    vectors_[i] = {vectorOf(sites, i), excess * (2 + excess)};
  });
}

std::uint32_t SphereWalk::to(const Direction& direction, std::uint32_t begin) const {
  const auto* offsets = diagram_.cell_offsets.data();
  const auto* neighbors = diagram_.neighbors.data();
  std::uint32_t best = begin;
  double least = lack(direction, best);
  while (true) {
    const std::uint32_t here = best;
    for (auto e = offsets[here]; e < offsets[here + std::size_t{1}]; ++e) {
      const auto site = static_cast<std::uint32_t>(neighbors[e]);
      const double found = lack(direction, site);
      if (found < least) {
        least = found;
        best = site;
      }
    }
    if (best == here) return best;
  }
}

}  // namespace vorpipe::core
