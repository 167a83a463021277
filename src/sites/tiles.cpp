#include "sites/tiles.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "base/parallel.h"
#include "base/try.h"
#include "sites/weights.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t rows_at_once = 16;

/// Break-even of the walk and the triangulation, in sites in 3 x 3 bins, where 18 are normal.
constexpr std::uint64_t most_around = 32;

/// Above this part of the cells, everything is crowded.
constexpr std::size_t many_crowded = 4;

/// By bin: whether its sites are crowded. Empty if none are.
std::vector<std::uint8_t> crowdedBins(const Grid& grid, int threads) {
  std::vector<std::uint8_t> is_crowded(std::size_t{grid.columns} * grid.rows);
  std::atomic<bool> any{false};
  parallelFor(grid.rows, rows_at_once, threadsForSteps(is_crowded.size(), threads),
              [&](std::size_t begin, std::size_t end) {
                bool some = false;
                for (auto row = static_cast<std::uint32_t>(begin); row < end; ++row) {
                  const auto bin = std::size_t{row} * grid.columns;
                  for (std::uint32_t column = 0; column < grid.columns; ++column) {
                    if (grid.offsets[bin + column] == grid.offsets[bin + column + 1]) continue;
                    const BinBlock around = withMargin(grid, {column, row, column, row}, 1);
                    if (sitesIn(grid, around) <= most_around) continue;
                    is_crowded[bin + column] = 1;
                    some = true;
                  }
                }
                if (some) any = true;
              });
  return any ? is_crowded : std::vector<std::uint8_t>{};
}

/// Adds the set's weights and heavy sites to a part, which already holds the sites in a block of the set's
/// bins. Heavy sites from elsewhere follow after the bins.
void takeWeights(const SiteSet& sites, const BinBlock& block, SiteSet& part,
                 std::vector<std::uint32_t>& whole) {
  const auto in_bins = static_cast<std::ptrdiff_t>(whole.size());
  for (const auto heavy : sites.heavy) {
    const auto end = whole.begin() + in_bins;
    const auto at = std::find(whole.begin(), end, heavy);
    part.heavy.push_back(static_cast<std::uint32_t>((at == end ? whole.end() : at) - whole.begin()));
    if (at != end) continue;
    whole.push_back(heavy);
    part.x.push_back(sites.x[heavy]);
    part.y.push_back(sites.y[heavy]);
    part.id.push_back(sites.id[heavy]);
  }
  for (const auto site : whole) part.weight.push_back(sites.weight[site]);
  for (auto row = block.south; row <= block.north; ++row) {
    const auto of_row = std::span(sites.grid.heaviest)
                            .subspan(std::size_t{row} * sites.grid.columns + block.west,
                                     block.east - block.west + std::size_t{1});
    part.grid.heaviest.insert(part.grid.heaviest.end(), of_row.begin(), of_row.end());
  }
  countBeyond(sites, block, part);
  buildPyramid(part.grid);
}

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

Crowds sortByCrowds(const Grid& grid, std::span<const std::uint32_t> which, int threads) {
  const auto is_crowded = crowdedBins(grid, threads);
  Crowds crowds;
  if (is_crowded.empty()) {
    crowds.even.assign(which.begin(), which.end());
    return crowds;
  }
  constexpr std::size_t grain = std::size_t{1} << 15;
  std::vector<Crowds> parts((which.size() + grain - 1) / grain);
  parallelFor(which.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    auto& part = parts[begin / grain];
    part.even.reserve(end - begin);
    const auto first = std::ranges::upper_bound(grid.offsets, which[begin]);
    auto bin = static_cast<std::size_t>(first - grid.offsets.begin()) - 1;
    for (auto k = begin; k < end; ++k) {
      while (grid.offsets[bin + 1] <= which[k]) ++bin;
      (is_crowded[bin] != 0 ? part.crowded : part.even).push_back(which[k]);
    }
  });
  crowds.even.reserve(which.size());
  for (const auto& part : parts) {
    crowds.even.insert(crowds.even.end(), part.even.begin(), part.even.end());
    crowds.crowded.insert(crowds.crowded.end(), part.crowded.begin(), part.crowded.end());
  }
  if (many_crowded * crowds.crowded.size() > which.size()) {
    crowds.crowded.assign(which.begin(), which.end());
    crowds.even.clear();
  }
  return crowds;
}

SiteSet cutOut(const SiteSet& sites, const BinBlock& block, std::vector<std::uint32_t>& whole) {
  const auto& grid = sites.grid;
  const auto x = [&](std::uint32_t column) { return grid.xmin + column * grid.size; };
  const auto y = [&](std::uint32_t row) { return grid.ymin + row * grid.size; };
  SiteSet set;
  set.domain = sites.domain;
  set.shorter_side = sites.shorter_side;
  set.has_images = sites.has_images;
  const auto& coverage = sites.coverage;
  set.coverage = {block.west == 0 ? coverage.xmin : x(block.west),
                  block.south == 0 ? coverage.ymin : y(block.south),
                  block.east + 1 == grid.columns ? coverage.xmax : x(block.east + 1),
                  block.north + 1 == grid.rows ? coverage.ymax : y(block.north + 1)};
  set.grid = {x(block.west),
              y(block.south),
              grid.size,
              block.east - block.west + 1,
              block.north - block.south + 1,
              {0}};
  whole.clear();
  for (auto row = block.south; row <= block.north; ++row) {
    const auto bin = std::size_t{row} * grid.columns;
    const auto begin = grid.offsets[bin + block.west];
    const auto end = grid.offsets[bin + block.east + 1];
    const auto row_first = static_cast<std::uint32_t>(whole.size());
    for (auto column = block.west; column <= block.east; ++column) {
      set.grid.offsets.push_back(grid.offsets[bin + column + 1] - begin + row_first);
    }
    whole.resize(whole.size() + (end - begin));
    std::iota(whole.begin() + row_first, whole.end(), begin);
    set.x.insert(set.x.end(), sites.x.begin() + begin, sites.x.begin() + end);
    set.y.insert(set.y.end(), sites.y.begin() + begin, sites.y.begin() + end);
    set.id.insert(set.id.end(), sites.id.begin() + begin, sites.id.begin() + end);
  }
  if (!sites.weight.empty()) takeWeights(sites, block, set, whole);
  return set;
}

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
