#include "session/tile_blocks.h"

#include <cmath>

namespace vorpipe::core {
namespace {

/// With random sites, one cell in millions reaches beyond its tile by this number of mean distances between
/// sites.
constexpr double enough = 6;
/// Surroundings of more than this share of a tile cost more than finding a few cells separately.
constexpr double worth = 0.25;

bool areSame(const BinBlock& a, const BinBlock& b) {
  return a.west == b.west && a.south == b.south && a.east == b.east && a.north == b.north;
}

/// Returns the mean distance of sites around a block, in cells of the lattice; infinite if there are none.
double distanceAround(const SiteCells& cells, const BinBlock& own, const BinBlock& with) {
  const auto area = static_cast<double>(binsIn(with) - binsIn(own));
  return std::sqrt(area / static_cast<double>(cells.count(with) - cells.count(own)));
}

/// Returns a block with its surroundings, which are wide where sites are few.
TileBlock withSurroundings(const SiteCells& cells, const BinBlock& own, std::uint64_t usual) {
  TileBlock tile{own, withMargin(cells.lattice(), own, 1), 0};
  const auto in_own = static_cast<double>(cells.count(own));
  for (std::uint32_t margin = 1; margin < enough * distanceAround(cells, own, tile.with); margin *= 2) {
    const BinBlock wider = withMargin(cells.lattice(), own, 2 * margin);
    const auto sites = cells.count(wider);
    if (areSame(wider, tile.with) || sites > usual || static_cast<double>(sites) > (1 + worth) * in_own)
      break;
    tile.with = wider;
  }
  tile.sites = cells.count(tile.with);
  return tile;
}

/// Cuts a block of more than one cell across its longer side into two parts with half of its sites each.
std::pair<BinBlock, BinBlock> cutInHalf(const SiteCells& cells, const BinBlock& block) {
  const bool upright = block.east - block.west > block.north - block.south;
  const auto half = cells.count(block) / 2;
  auto lower = block, upper = block;
  auto low = upright ? block.west : block.south, high = (upright ? block.east : block.north) - 1;
  while (low < high) {
    const auto middle = low + (high - low) / 2;
    (upright ? lower.east : lower.north) = middle;
    if (cells.count(lower) < half) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  (upright ? lower.east : lower.north) = low;
  (upright ? upper.west : upper.south) = low + 1;
  return {lower, upper};
}

}  // namespace

std::vector<TileBlock> tilesOf(const SiteCells& cells, std::uint64_t usual) {
  std::vector<TileBlock> tiles;
  std::vector<BinBlock> pending{cells.all()};
  while (!pending.empty()) {
    const auto block = pending.back();
    pending.pop_back();
    if (cells.count(block) == 0) continue;
    if (binsIn(block) == 1 || cells.count(withMargin(cells.lattice(), block, 1)) <= usual) {
      tiles.push_back(withSurroundings(cells, block, usual));
    } else {
      const auto [lower, upper] = cutInHalf(cells, block);
      pending.push_back(upper);
      pending.push_back(lower);
    }
  }
  return tiles;
}

}  // namespace vorpipe::core
