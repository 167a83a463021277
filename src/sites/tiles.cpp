#include "sites/tiles.h"

#include <algorithm>

#include "base/try.h"
#include "sites/crowds.h"
#include "sites/cut_out.h"

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
                                            const std::function<Result<void>(const Tile&)>& work) {
  auto [even, left] = sortByCrowds(sites.grid, which, threads);
  if (even.empty()) return std::move(left);
  if (fits(sites, info)) {
    VORPIPE_TRY(work({sites, even, {}}));
    return std::move(left);
  }
  const auto heavy = std::min<std::uint64_t>(sites.heavy.size(), info.max_sites);
  const auto plan = planTiles(sites.grid, info.max_sites - heavy, info.max_bins);
  std::vector<std::uint32_t> whole;
  for (const auto& tile : plan.tiles) {
    const auto own = ownCells(sites.grid, tile, even);
    if (own.empty()) continue;
    const auto set = cutOut(sites, withMargin(sites.grid, tile, halo), whole);
    VORPIPE_TRY(work({set, own, whole}));
  }
  for (const auto& bin : plan.unfit) {
    const auto cells = ofRow(sites.grid, bin, bin.south, even);
    left.insert(left.end(), cells.begin(), cells.end());
  }
  return std::move(left);
}

}  // namespace vorpipe::core
