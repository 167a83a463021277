#include "session/open_cells.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <set>

#include "base/refusal.h"
#include "base/try.h"
#include "cells/neighbor_rows.h"
#include "session/tiles.h"

namespace vorpipe::core {
namespace {

using Numbers = std::vector<std::uint32_t>;

void append(Numbers& to, std::span<const std::uint32_t> from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// The results of one run over some of the sites.
struct Left {
  Numbers settled;  ///< by index in the part
  Numbers open;     ///< by number in the whole run, as are all below
  Numbers around;   ///< their neighbors
  Numbers nearer;   ///< sites nearer to corners than the cells' own sites
};

/// Large discs without other sites; corners of many cells may coincide.
class ClearDiscs {
 public:
  using Key = std::array<std::int64_t, 3>;
  /// Rounds the disc of a corner in the domain, by less than the margin of the search around it.
  static std::optional<Key> keyOf(const CornerDisc& disc) {
    constexpr double least = 0x1p-14, farthest = 0x1p20, steps = 0x1p40;
    const bool is_small = !(disc.radius >= least && disc.radius < farthest);
    const bool is_far = !(std::abs(disc.center.x) < farthest && std::abs(disc.center.y) < farthest);
    if (is_small || is_far) return std::nullopt;
    const auto rounded = [](double value) { return std::int64_t{std::llround(value * steps)}; };
    return Key{rounded(disc.center.x), rounded(disc.center.y), rounded(disc.radius)};
  }
  bool has(const Key& key) {
    const std::scoped_lock lock(mutex_);
    return keys_.contains(key);
  }
  void add(const Key& key) {
    const std::scoped_lock lock(mutex_);
    keys_.insert(key);
  }

 private:
  std::mutex mutex_;
  std::set<Key> keys_;
};

/// Looks for sites outside the part that cut its cells, or tie with them; `most` at each corner.
Left lookAround(const SiteCells& cells, const PartSites& part, const PartCells& found, std::size_t most,
                int threads) {
  constexpr double tied = 1 + 1e-6;
  const auto& set = found.run->prepared.set;
  const auto isOther = [&](std::uint32_t site) { return !std::ranges::binary_search(part.number, site); };
  std::mutex mutex;
  ClearDiscs clear;
  Left left;
  Numbers open;
  eachCellsDiscs(found, part.own, threads, [&](std::uint32_t i, auto row, auto discs) {
    Numbers nearer;
    for (const CornerDisc& disc : discs) {
      const auto key = ClearDiscs::keyOf(disc);
      if (key && clear.has(*key)) continue;
      const auto before = nearer.size();
      cells.addNear(disc.center, disc.radius * tied, most, isOther, nearer);
      if (key && nearer.size() == before) clear.add(*key);
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
    const SiteCells& cells, OpenCells open, std::uint64_t most, int threads, const FindPart& find,
    const std::function<Result<void>(const PartSites& part, const PartCells& found,
                                     std::span<const std::uint32_t> which)>& settled) {
  sortWithoutRepeats(open.sites);
  Numbers own = std::move(open.sites), others = std::move(open.around);
  // If corners tie with many sites, as on a circle, the number at a corner grows.
  for (std::size_t at_corner = 1; !own.empty(); at_corner *= 4) {
    Numbers all = others;
    append(all, own);
    sortWithoutRepeats(all);
    if (all.size() > most) {
      return tl::unexpected(refusal(
          Subject::sites, fmt::format("the cells of {} of them reach so far that they take {} sites at "
                                      "a time, more than the {} that a tile may have",
                                      own.size(), all.size(), most)));
    }
    const PartSites part = sitesOf(cells, all, own);
    VORPIPE_LET(found, find(part, frameOf(cells)));
    Left left = lookAround(cells, part, found, at_corner, threads);
    VORPIPE_TRY(settled(part, found, left.settled));
    own = std::move(left.open);
    // Sites of earlier rounds stay: a site that ties with a corner need not be a neighbor.
    append(others, left.around);
    append(others, left.nearer);
    sortWithoutRepeats(others);
  }
  return {};
}

}  // namespace vorpipe::core
