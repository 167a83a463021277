#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "base/try.h"
#include "cells/cell_walk.h"
#include "session/tiles.h"

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

namespace {

constexpr std::size_t part_grain = std::size_t{1} << 14;

/// Sorts in ascending order by radix, from the lowest bits on: several times as fast as by comparison.
void sortNumbers(std::vector<std::uint32_t>& numbers) {
  constexpr unsigned bits = 11, rounds = 3;
  constexpr std::size_t buckets = std::size_t{1} << bits;
  std::vector<std::uint32_t> other(numbers.size());
  for (unsigned round = 0; round < rounds; ++round) {
    const auto bucketOf = [shift = round * bits](std::uint32_t n) { return (n >> shift) % buckets; };
    std::array<std::size_t, buckets + 1> next{};
    for (const auto n : numbers) ++next[bucketOf(n) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (const auto n : numbers) other[next[bucketOf(n)]++] = n;
    numbers.swap(other);
  }
}

/// Sorts the sites of a set with one bin into their order in the run's grid.
void takeOrder(const SiteCells& cells, SiteSet& set) {
  std::vector<std::uint32_t> bin(set.size()), order(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) bin[i] = cells.bin({set.x[i], set.y[i]});
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return bin[i]; });
  SiteSet ordered = set;
  for (std::size_t k = 0; k < order.size(); ++k) {
    ordered.x[k] = set.x[order[k]];
    ordered.y[k] = set.y[order[k]];
    ordered.id[k] = set.id[order[k]];
  }
  set = std::move(ordered);
}

}  // namespace

PartSites sitesOf(const SiteCells& cells, const TileBlock& tile, int threads) {
  PartSites part;
  // Twice the number, plus one if the site is the tile's own: numbers are less than 2^31.
  std::vector<std::uint32_t> flagged;
  flagged.reserve(tile.sites);
  const auto add = [&](const BinBlock& block, std::uint32_t own) {
    cells.eachRow(block, [&](std::span<const std::uint32_t> sites) {
      for (const auto site : sites) flagged.push_back(2 * site + own);
    });
  };
  const auto &own = tile.own, &with = tile.with;
  add(own, 1);
  if (with.south < own.south) add({with.west, with.south, with.east, own.south - 1}, 0);
  if (with.north > own.north) add({with.west, own.north + 1, with.east, with.north}, 0);
  if (with.west < own.west) add({with.west, own.south, own.west - 1, own.north}, 0);
  if (with.east > own.east) add({own.east + 1, own.south, with.east, own.north}, 0);
  sortNumbers(flagged);
  const auto count = flagged.size();
  part.sites.x.resize(count);
  part.sites.y.resize(count);
  part.own.resize(count);
  parallelEach(count, part_grain, threads, [&](std::size_t i) {
    part.own[i] = static_cast<std::uint8_t>(flagged[i] % 2);
    flagged[i] /= 2;
    part.sites.x[i] = cells.sites().x[flagged[i]];
    part.sites.y[i] = cells.sites().y[flagged[i]];
  });
  part.number = std::move(flagged);
  return part;
}

PartSites sitesOf(const SiteCells& cells, std::span<const std::uint32_t> all,
                  std::span<const std::uint32_t> own) {
  PartSites part;
  auto next = own.begin();
  for (const auto site : all) {
    part.number.push_back(site);
    part.sites.x.push_back(cells.sites().x[site]);
    part.sites.y.push_back(cells.sites().y[site]);
    const bool is_own = next != own.end() && *next == site;
    part.own.push_back(is_own ? 1 : 0);
    if (is_own) ++next;
  }
  return part;
}

PartFrame frameOf(const SiteCells& cells, const TileBlock& tile) {
  const Grid& grid = cells.grid();
  const BinBlock bins = cells.binsOf(tile.with);
  const auto x = [&](std::uint32_t column) { return grid.xmin + column * grid.size; };
  const auto y = [&](std::uint32_t row) { return grid.ymin + row * grid.size; };
  const Box& domain = cells.domain();
  const Box box{bins.west == 0 ? domain.xmin : std::max(domain.xmin, x(bins.west)),
                bins.south == 0 ? domain.ymin : std::max(domain.ymin, y(bins.south)),
                bins.east + 1 == grid.columns ? domain.xmax : std::min(domain.xmax, x(bins.east + 1)),
                bins.north + 1 == grid.rows ? domain.ymax : std::min(domain.ymax, y(bins.north + 1))};
  const Grid of_tile{
      x(bins.west), y(bins.south), grid.size, bins.east - bins.west + 1, bins.north - bins.south + 1, {}};
  return {{cells.exponent(), box, shorterSide(domain), of_tile, {&grid, bins.west, bins.south}, {}}, true};
}

PartFrame frameOf(const SiteCells& cells) {
  const Box& domain = cells.domain();
  const double side = std::max(domain.xmax - domain.xmin, domain.ymax - domain.ymin);
  return {{cells.exponent(), domain, shorterSide(domain), {domain.xmin, domain.ymin, side, 1, 1, {}}, {}, {}},
          false};
}

Result<PartCells> cellsOfPart(const Machine& machine, const SiteCells& cells, const PartSites& part,
                              PartFrame frame, const SearchOptions& search, const Progress& progress) {
  frame.prepared.names = part.number;
  VORPIPE_VAR(prepared, preparePart(part.sites, frame.prepared, machine.threads));
  if (!frame.has_order) takeOrder(cells, prepared.set);
  const Unscale unscale(cells.exponent());
  const Box& box = frame.prepared.domain;
  CellsOptions options{};
  options.domain = {unscale(box.xmin), unscale(box.ymin), unscale(box.xmax), unscale(box.ymax)};
  options.search = search;
  options.detail = Detail::measures;
  options.progress = progress;
  auto run = std::make_unique<SiteRun>(std::move(prepared), machine);
  Report report;
  VORPIPE_VAR(agreed, agreeOnCells(machine, *run, part.sites, options, AtEmpty::ignore, {}, report));
  nameDevice(machine.backend, report);
  return PartCells{std::move(run), std::move(*agreed), std::move(report)};
}

CellMeasures measuresOf(const PartSites& part, const PartCells& cells, std::size_t i) {
  const CellRecord& record = cells.agreed.records[i];
  // The centroid of a site without a cell is the site, equal to the caller's to the last bit.
  const bool is_empty = record.status == Status::empty;
  return {record.area, is_empty ? Point{part.sites.x[i], part.sites.y[i]} : record.centroid, record.edges,
          record.status};
}

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
