#include "session/part.h"

#include <array>
#include <cmath>
#include <numeric>

#include "base/parallel.h"

namespace vorpipe::core {
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
  parallelFor(count, part_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      part.own[i] = static_cast<std::uint8_t>(flagged[i] % 2);
      flagged[i] /= 2;
      part.sites.x[i] = cells.sites().x[flagged[i]];
      part.sites.y[i] = cells.sites().y[flagged[i]];
    }
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
  auto prepared = preparePart(part.sites, frame.prepared, machine.threads);
  if (!prepared) return tl::unexpected(prepared.error());
  if (!frame.has_order) takeOrder(cells, prepared->set);
  const Unscale unscale(cells.exponent());
  const Box& box = frame.prepared.domain;
  CellsOptions options{};
  options.domain = {unscale(box.xmin), unscale(box.ymin), unscale(box.xmax), unscale(box.ymax)};
  options.search = search;
  options.detail = Detail::measures;
  options.progress = progress;
  auto run = std::make_unique<SiteRun>(std::move(*prepared), machine);
  Report report;
  auto agreed = agreeOnCells(machine, *run, part.sites, options, {}, report);
  if (!agreed) return tl::unexpected(agreed.error());
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

}  // namespace vorpipe::core
