#include "core/tiled/open_cells.h"

#include <algorithm>
#include <iterator>
#include <mutex>

#include "core/tiled/closed.h"

namespace vorpipe::core {
namespace {

using Numbers = std::vector<std::uint32_t>;

void sortUnique(Numbers& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

void append(Numbers& to, std::span<const std::uint32_t> from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// What one run over some of the sites leaves.
struct Left {
  Numbers settled;  ///< by index in the part
  Numbers open;     ///< by number in the whole run, as all below
  Numbers around;   ///< their neighbors
  Numbers nearer;   ///< the nearest to corners that do not belong to their cells
};

/// Looks for sites that are not in the part and cut its cells, or tie with them.
Left lookAround(const SiteCells& cells, const PartSites& part, const PartCells& found, int threads) {
  constexpr double tied = 1 + 1e-6;
  const auto& set = found.run->prepared.set;
  const auto isOther = [&](std::uint32_t site) { return !std::ranges::binary_search(part.number, site); };
  std::mutex mutex;
  Left left;
  Numbers open;
  eachCellsDiscs(found, part.own, threads, [&](std::uint32_t i, auto row, auto discs) {
    Numbers nearer;
    for (const CornerDisc& disc : discs) {
      if (const auto site = cells.nearest(disc.center, disc.radius * tied, isOther)) nearer.push_back(*site);
    }
    if (nearer.empty()) return;
    const std::scoped_lock lock(mutex);
    open.push_back(i);
    append(left.nearer, nearer);
    for (const auto neighbor : row) {
      if (neighbor >= 0) left.around.push_back(part.number[set.id[static_cast<std::size_t>(neighbor)]]);
    }
  });
  std::ranges::sort(open);
  for (std::uint32_t i = 0; i < part.own.size(); ++i) {
    if (part.own[i] == 0) continue;
    if (std::ranges::binary_search(open, i)) {
      left.open.push_back(part.number[i]);
    } else {
      left.settled.push_back(i);
    }
  }
  return left;
}

}  // namespace

Result<void> settleOpenCells(
    const SiteCells& cells, OpenCells open, int threads, const FindPart& find,
    const std::function<Result<void>(const PartSites& part, const PartCells& found,
                                     std::span<const std::uint32_t> which)>& settled) {
  sortUnique(open.sites);
  Numbers own = std::move(open.sites), others = std::move(open.around);
  while (!own.empty()) {
    Numbers all = others;
    append(all, own);
    sortUnique(all);
    const PartSites part = sitesOf(cells, all, own);
    const auto found = find(part, frameOf(cells));
    if (!found) return tl::unexpected(found.error());
    Left left = lookAround(cells, part, *found, threads);
    if (auto took = settled(part, *found, left.settled); !took) return took;
    own = std::move(left.open);
    others = std::move(left.around);
    append(others, left.nearer);
  }
  return {};
}

}  // namespace vorpipe::core
