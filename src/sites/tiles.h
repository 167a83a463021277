/// Parts of a set of sites that fit a device, for sets that do not.
#pragma once

#include <functional>

#include "backend/backend.h"
#include "sites/grid.h"

namespace vorpipe::core {

/// The sites that a device gets at a time: all, or those of a rectangle of bins and of a halo around it.
struct Tile {
  const SiteSet& sites;
  std::span<const std::uint32_t> own;    ///< the cells to find, indices in `sites`, ascending
  std::span<const std::uint32_t> whole;  ///< by index in `sites`: index in the whole set; empty if the same

  [[nodiscard]] std::uint32_t wholeIndex(std::uint32_t i) const { return whole.empty() ? i : whole[i]; }
};

/// The rectangles of bins that a device gets one after the other. Every bin is in one of them.
struct TilePlan {
  std::vector<BinBlock> tiles;
  std::vector<BinBlock> unfit;  ///< bins that do not fit together with their halo
};

/// Cuts the grid into halves until each part, with its halo, has at most that many sites and bins.
TilePlan planTiles(const Grid& grid, std::uint64_t most_sites, std::uint64_t most_bins);

/// Whether a device can be given all sites at once.
bool fits(const SiteSet& sites, const BackendInfo& info);

/// Calls `work` with all sites if the device can take them, else with one tile after the other. Each cell of
/// `which` (ascending) is in the `own` of at most one of these parts. Returns the cells that are in no part,
/// in any order: crowds, and bins that do not fit.
Result<std::vector<std::uint32_t>> forTiles(const SiteSet& sites, const BackendInfo& info,
                                            std::span<const std::uint32_t> which, int threads,
                                            const std::function<Result<void>(const Tile&)>& work);

struct Crowds {
  std::vector<std::uint32_t> even;     ///< sites whose cells a walk over the grid finds fast, ascending
  std::vector<std::uint32_t> crowded;  ///< the others, ascending
};

/// Sorts the sites `which` (ascending) by how many stand in the 3 x 3 bins around them. If many of them are
/// crowded, counts all as crowded: their triangulation is then made anyway, and including the rest costs
/// little.
Crowds sortByCrowds(const Grid& grid, std::span<const std::uint32_t> which, int threads);

/// Returns the sites of a block of bins as a separate set. Its `coverage` is the block, except where the
/// block ends with the grid: there it is that of `sites`. whole[i] is the index in `sites` of site i. Heavy
/// sites from elsewhere are in the set, but in none of its bins.
SiteSet cutOut(const SiteSet& sites, const BinBlock& block, std::vector<std::uint32_t>& whole);

}  // namespace vorpipe::core
