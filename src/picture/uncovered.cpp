#include "picture/uncovered.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t uncovered_grain = std::size_t{1} << 16;
/// Number of pixels per query to the judge: a device may have covered none.
constexpr std::size_t most_at_once = std::size_t{1} << 20;

bool areAllCovered(const NearestSites& nearest, std::span<const std::uint32_t> ids) {
  std::atomic<bool> all = true;
  parallelFor(ids.size(), uncovered_grain, threadsForSteps(ids.size(), nearest.threads),
              [&](std::size_t begin, std::size_t end) {
                const auto part = ids.subspan(begin, end - begin);
                if (std::ranges::any_of(part, [&](auto id) { return id >= nearest.ids; })) all = false;
              });
  return all;
}

}  // namespace

std::uint64_t coverRest(const NearestSites& nearest, const View& view, std::span<std::uint32_t> rgba,
                        std::span<std::uint32_t> ids) {
  if (areAllCovered(nearest, ids)) return 0;
  std::uint64_t count = 0;
  std::vector<std::uint32_t> pixels;
  std::vector<std::uint32_t> sites;
  for (std::size_t next = 0; next < ids.size();) {
    pixels.clear();
    for (; next < ids.size() && pixels.size() < most_at_once; ++next) {
      if (ids[next] >= nearest.ids) pixels.push_back(static_cast<std::uint32_t>(next));
    }
    sites.resize(pixels.size());
    nearest.judge.nearest(view, pixels, sites);
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      const bool none = sites[k] == no_site;
      ids[pixels[k]] = none ? no_site : nearest.sites.id[sites[k]];
      rgba[pixels[k]] = none ? 0 : view.palette[nearest.palette_index[sites[k]]];
    }
    count += pixels.size();
  }
  return count;
}

}  // namespace vorpipe::core
