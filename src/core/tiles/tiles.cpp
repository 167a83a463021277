#include "core/tiles/tiles.h"

#include <algorithm>

#include "core/tiles/cut_out.h"
#include "core/tiles/refine.h"

namespace vorpipe::core {
namespace {

/// On each side of a tile, in bins: with evenly spread sites nearly every flower ends in it.
constexpr std::uint32_t halo = 5;

bool fitsWithHalo(const Grid& grid, const BinBlock& tile, std::uint64_t most_sites, std::uint64_t most_bins) {
  const auto block = withMargin(grid, tile, halo);
  return binsIn(block) <= most_bins && sitesIn(grid, block) <= most_sites;
}

/// The cells of `which` whose sites are in a row of a block.
std::span<const std::uint32_t> ofRow(const Grid& grid, const BinBlock& block, std::uint32_t row,
                                     std::span<const std::uint32_t> which) {
  const auto bin = std::size_t{row} * grid.columns;
  const auto begin = std::lower_bound(which.begin(), which.end(), grid.offsets[bin + block.west]);
  const auto end = std::lower_bound(begin, which.end(), grid.offsets[bin + block.east + 1]);
  return {begin, end};
}

/// The cells of `which` that are a tile's own, as indices in the set of its sites.
std::vector<std::uint32_t> ownCells(const Grid& grid, const BinBlock& tile,
                                    std::span<const std::uint32_t> which) {
  const auto block = withMargin(grid, tile, halo);
  std::vector<std::uint32_t> own;
  std::uint32_t row_first = 0;
  for (auto row = block.south; row <= block.north; ++row) {
    const auto bin = std::size_t{row} * grid.columns;
    const auto begin = grid.offsets[bin + block.west];
    if (row >= tile.south && row <= tile.north) {
      for (const auto site : ofRow(grid, tile, row, which)) own.push_back(site - begin + row_first);
    }
    row_first += grid.offsets[bin + block.east + 1] - begin;
  }
  return own;
}

/// Calls work for a set, its tiles and its crowded regions, and theirs.
class Parts {
 public:
  Parts(const BackendInfo& info, int threads, const std::function<Result<void>(const Tile&)>& work,
        const std::function<bool()>& is_over)
      : info_(info), threads_(threads), work_(work), is_over_(is_over) {}

  Result<void> work(const Tile& part, int depth) {
    auto crowding = sortByCrowding(part.sites.grid, part.own, threads_);
    leave(part, crowding.hopeless);
    if (auto worked = workOnTiles({part.sites, crowding.even, part.whole}); !worked) return worked;
    for (const auto& region : crowding.regions) {
      if (depth == deepest || is_over_()) {
        leave(part, region.own);
        continue;
      }
      auto refined = refine(part.sites, region, threads_);
      for (auto& i : refined.whole) i = part.wholeIndex(i);
      if (auto worked = work({refined.sites, refined.own, refined.whole}, depth + 1); !worked) return worked;
    }
    return {};
  }

  std::vector<std::uint32_t> left;  ///< in the whole set

 private:
  Result<void> workOnTiles(const Tile& part) {
    if (part.own.empty()) return {};
    if (fits(part.sites, info_)) return work_(part);
    const auto heavy = std::min<std::uint64_t>(part.sites.heavy.size(), info_.max_sites);
    const auto plan = planTiles(part.sites.grid, info_.max_sites - heavy, info_.max_bins);
    std::vector<std::uint32_t> whole;
    for (const auto& tile : plan.tiles) {
      const auto own = ownCells(part.sites.grid, tile, part.own);
      if (own.empty()) continue;
      const auto set = cutOut(part.sites, withMargin(part.sites.grid, tile, halo), whole);
      for (auto& i : whole) i = part.wholeIndex(i);
      if (auto worked = work_({set, own, whole}); !worked) return worked;
    }
    for (const auto& bin : plan.unfit) leave(part, ofRow(part.sites.grid, bin, bin.south, part.own));
    return {};
  }

  void leave(const Tile& part, std::span<const std::uint32_t> cells) {
    for (const auto i : cells) left.push_back(part.wholeIndex(i));
  }

  /// Depth of nested clusters; each grid may be a thousand times finer than the one before.
  static constexpr int deepest = 4;

  const BackendInfo& info_;
  int threads_;
  const std::function<Result<void>(const Tile&)>& work_;
  const std::function<bool()>& is_over_;
};

}  // namespace

TilePlan planTiles(const Grid& grid, std::uint64_t most_sites, std::uint64_t most_bins) {
  TilePlan plan;
  std::vector<BinBlock> pending{{0, 0, grid.columns - 1, grid.rows - 1}};
  while (!pending.empty()) {
    const auto block = pending.back();
    pending.pop_back();
    if (fitsWithHalo(grid, block, most_sites, most_bins)) {
      plan.tiles.push_back(block);
    } else if (binsIn(block) == 1) {
      plan.unfit.push_back(block);
    } else {
      const auto [lower, upper] = halves(block);
      pending.push_back(upper);
      pending.push_back(lower);
    }
  }
  return plan;
}

bool fits(const SiteSet& sites, const BackendInfo& info) {
  return sites.size() <= info.max_sites &&
         std::uint64_t{sites.grid.columns} * sites.grid.rows <= info.max_bins;
}

Result<std::vector<std::uint32_t>> forTiles(const SiteSet& sites, const BackendInfo& info,
                                            std::span<const std::uint32_t> which, int threads,
                                            const std::function<Result<void>(const Tile&)>& work,
                                            const std::function<bool()>& is_over) {
  Parts parts(info, threads, work, is_over);
  if (auto worked = parts.work({sites, which, {}}, 0); !worked) return tl::unexpected(worked.error());
  return std::move(parts.left);
}

}  // namespace vorpipe::core
