#include "session/closed.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "cells/cell_walk.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t closed_grain = 4096;
/// Relative tolerance of distances: other sites that are about as near to a corner as its own may be a tie.
constexpr double beyond = 1e-4;

bool isWithin(const Box& box, const CornerDisc& disc) {
  const double radius = disc.radius * (1 + beyond);
  return disc.center.x - radius > box.xmin && disc.center.x + radius < box.xmax &&
         disc.center.y - radius > box.ymin && disc.center.y + radius < box.ymax;
}

bool isClosed(const KnownBox& known, std::span<const std::int32_t> row, std::span<const CornerDisc> discs) {
  const bool at_own_wall = std::ranges::any_of(row, [&](std::int32_t neighbor) {
    return isWall(neighbor) && !known.true_walls[static_cast<std::size_t>(-1 - neighbor)];
  });
  return !at_own_wall && std::ranges::all_of(discs, [&](const CornerDisc& disc) {
    return isWithin(known.sites, disc) && 2 * disc.radius < known.longest;
  });
}

}  // namespace

KnownBox knownBox(const SiteCells& cells, const TileBlock& tile) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Grid& lattice = cells.lattice();
  const BinBlock& with = tile.with;
  const auto frame = frameOf(cells, tile).prepared;
  const Box &domain = cells.domain(), &own = frame.domain;
  KnownBox known;
  known.sites = {
      with.west == 0 ? -infinite : frame.grid.xmin, with.south == 0 ? -infinite : frame.grid.ymin,
      with.east + 1 == lattice.columns ? infinite : frame.grid.xmin + frame.grid.columns * frame.grid.size,
      with.north + 1 == lattice.rows ? infinite : frame.grid.ymin + frame.grid.rows * frame.grid.size};
  known.true_walls = {own.xmin == domain.xmin, own.xmax == domain.xmax, own.ymin == domain.ymin,
                      own.ymax == domain.ymax};
  const bool is_whole = std::ranges::all_of(known.true_walls, [](bool is_true) { return is_true; });
  known.longest = is_whole ? infinite : shorterSide(own);
  return known;
}

void eachCellsDiscs(const PartCells& cells, const std::vector<std::uint8_t>& wanted, int threads,
                    const std::function<void(std::uint32_t i, std::span<const std::int32_t> row,
                                             std::span<const CornerDisc> discs)>& take) {
  const SiteSet& set = cells.run->prepared.set;
  parallelFor(set.size(), grainFor(set.size(), closed_grain), threads,
              [&](std::size_t begin, std::size_t end) {
                std::vector<CornerDisc> discs;
                CellWalk walk(set, cells.agreed.rows);
                walk(begin, end, [&](std::uint32_t cell, auto row, auto corners) {
                  const auto i = set.id[cell];
                  if (wanted[i] == 0) return;
                  discs.clear();
                  for (const auto& corner : corners) {
                    const Point seen = relativeTo({set.x[cell], set.y[cell]}, corner);
                    discs.push_back({positionOf(corner), std::hypot(seen.x, seen.y)});
                  }
                  take(i, row, discs);
                });
              });
}

std::vector<std::uint32_t> openCells(const PartSites& part, const PartCells& cells, const KnownBox& known,
                                     int threads) {
  std::vector<std::uint8_t> is_open(part.own.size());
  eachCellsDiscs(cells, part.own, threads, [&](std::uint32_t i, auto row, auto discs) {
    is_open[i] = isClosed(known, row, discs) ? 0 : 1;
  });
  const bool is_whole = known.longest == std::numeric_limits<double>::infinity();
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < is_open.size(); ++i) {
    // A site outside of the domain may have its cell in another tile.
    const bool elsewhere = !is_whole && part.own[i] != 0 && cells.agreed.records[i].status == Status::empty;
    if (is_open[i] != 0 || elsewhere) open.push_back(i);
  }
  return open;
}

}  // namespace vorpipe::core
