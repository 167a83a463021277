#include "core/tiles/refine.h"

#include <limits>
#include <numeric>

#include "core/sites/bin_sort.h"
#include "core/sites/weight_pyramid.h"
#include "core/tiles/cut_out.h"

namespace vorpipe::core {
namespace {

/// Bins of the old grid around a region: in a crowd, cells are much smaller than bins.
constexpr std::uint32_t old_margin = 1;
/// Bins of the new grid around the region's own sites.
constexpr std::uint32_t new_margin = 3;

/// A grid over the sites `own` with a margin.
Grid gridOver(const SiteSet& sites, const std::vector<std::uint32_t>& own) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Box box{infinite, infinite, -infinite, -infinite};
  for (const auto i : own) {
    box = {std::min(box.xmin, sites.x[i]), std::min(box.ymin, sites.y[i]), std::max(box.xmax, sites.x[i]),
           std::max(box.ymax, sites.y[i])};
  }
  auto grid = layGrid(box, own.size());
  grid.xmin -= new_margin * grid.size;
  grid.ymin -= new_margin * grid.size;
  grid.columns += 2 * new_margin;
  grid.rows += 2 * new_margin;
  return grid;
}

/// Gives weights to a refined region; in_tile[i] is the index of its site i in the tile around it.
void takeWeights(const SiteSet& sites, const BinBlock& block, const SiteSet& tile,
                 const std::vector<std::uint32_t>& in_tile, int threads, SiteSet& refined) {
  std::vector<std::uint32_t> place(tile.size());
  for (std::uint32_t i = 0; i < in_tile.size(); ++i) {
    refined.weight.push_back(tile.weight[in_tile[i]]);
    place[in_tile[i]] = i;
  }
  for (const auto heavy : tile.heavy) refined.heavy.push_back(place[heavy]);
  noteHeaviest(refined, threads);
  countBeyond(sites, block, refined);
  buildPyramid(refined.grid);
}

}  // namespace

RefinedRegion refine(const SiteSet& sites, const CrowdedRegion& region, int threads) {
  std::vector<std::uint32_t> known;
  const auto block = withMargin(sites.grid, region.block, old_margin);
  const auto tile = cutOut(sites, block, known);
  RefinedRegion refined;
  refined.sites.domain = sites.domain;
  refined.sites.shorter_side = sites.shorter_side;
  refined.sites.has_images = sites.has_images;
  refined.sites.coverage = tile.coverage;
  refined.sites.grid = gridOver(sites, region.own);
  std::vector<std::uint32_t> owner;
  orderByBins({tile.x, tile.y, {}}, PowerOfTwo(0), threads, refined.sites, owner);
  if (!sites.weight.empty()) takeWeights(sites, block, tile, refined.sites.id, threads, refined.sites);

  std::vector<bool> is_own(known.size());
  auto next = region.own.begin();
  for (std::size_t i = 0; i < known.size() && next != region.own.end(); ++i) {
    is_own[i] = known[i] == *next;
    next += is_own[i] ? 1 : 0;
  }
  for (std::uint32_t i = 0; i < refined.sites.size(); ++i) {
    const auto in_tile = refined.sites.id[i];
    if (is_own[in_tile]) refined.own.push_back(i);
    refined.whole.push_back(known[in_tile]);
    refined.sites.id[i] = tile.id[in_tile];
  }
  return refined;
}

}  // namespace vorpipe::core
