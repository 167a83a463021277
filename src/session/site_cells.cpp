#include "session/site_cells.h"

#include <fmt/core.h>

#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t site_cells_grain = std::size_t{1} << 16;
constexpr std::uint64_t most_sites = std::numeric_limits<std::int32_t>::max();
/// Number of parts sorted in parallel: each has a count for every cell of the lattice.
constexpr int most_parts = 8;

Error cancelled() { return {ErrorCode::cancelled, "cancelled"}; }

bool goesOn(const Progress& progress, double fraction) { return !progress || progress("sites", fraction); }

}  // namespace

SiteCells::SiteCells(const SitesInPlace& sites, const Box& domain)
    : sites_(sites), exponent_(scaleExponent(domain)), scale_(exponent_) {
  domain_ = scaledDomain(domain, exponent_);
}

Result<SiteCells> SiteCells::over(const SitesInPlace& sites, const Box& domain, int threads,
                                  const Progress& progress) {
  VORPIPE_TRY(checkDomain(domain));
  if (sites.count == 0) return tl::unexpected(refusal(Subject::sites, "there are no sites"));
  if (sites.count > most_sites) {
    return tl::unexpected(
        refusal(Subject::sites, fmt::format("{} sites are more than {}", sites.count, most_sites)));
  }
  SiteCells cells(sites, domain);
  if (!goesOn(progress, 0)) return tl::unexpected(cancelled());
  VORPIPE_TRY(cells.findGrid(threads));
  if (!goesOn(progress, 0.5)) return tl::unexpected(cancelled());
  cells.sort(threads);
  cells.addUp();
  return cells;
}

/// Lays the grid that prepare() would lay.
Result<void> SiteCells::findGrid(int threads) {
  const Box near = surroundings(domain_);
  std::vector<Extent> extents((sites_.count + site_cells_grain - 1) / site_cells_grain);
  parallelFor(sites_.count, site_cells_grain, threads, [&](std::size_t begin, std::size_t end) {
    Extent extent;
    for (auto i = begin; i < end; ++i) {
      const Point p = place(i);
      extent.add(p.x, p.y, near);
    }
    extents[begin / site_cells_grain] = extent;
  });
  Extent all;
  for (const auto& extent : extents) all.add(extent);
  if (!all.usable) {
    const auto isUsable = [](double value) { return std::abs(value) <= farthest_site; };
    std::size_t i = 0;
    while (isUsable(place(i).x) && isUsable(place(i).y)) ++i;
    return tl::unexpected(unusableSite(i, sites_.x[i], sites_.y[i]));
  }
  grid_ = gridOver(all, near);
  const auto along = [](std::uint32_t bins) { return (bins + bins_along - 1) / bins_along; };
  lattice_ = {grid_.xmin, grid_.ymin, bins_along * grid_.size, along(grid_.columns), along(grid_.rows), {}};
  return {};
}

std::uint32_t SiteCells::cellOf(std::size_t site) const {
  const Point p = place(site);
  const auto column = binAlong(p.x, grid_.xmin, grid_.size, grid_.columns) / bins_along;
  const auto row = binAlong(p.y, grid_.ymin, grid_.size, grid_.rows) / bins_along;
  return row * lattice_.columns + column;
}

/// A stable counting sort, in parallel parts of the input.
void SiteCells::sort(int threads) {
  const std::size_t cells = std::size_t{lattice_.columns} * lattice_.rows;
  const auto parts = static_cast<std::size_t>(std::min(threadCount(threads), most_parts));
  const std::size_t length = (sites_.count + parts - 1) / parts;
  std::vector<std::vector<std::uint32_t>> next(parts);
  const auto forPart = [&](std::size_t part, const auto& each) {
    const auto end = std::min<std::size_t>(sites_.count, (part + 1) * length);
    for (auto i = part * length; i < end; ++i) each(i, cellOf(i));
  };
  parallelFor(parts, 1, threads, [&](std::size_t part, std::size_t) {
    next[part].resize(cells);
    forPart(part, [&](std::size_t, std::uint32_t cell) { ++next[part][cell]; });
  });
  offsets_.resize(cells + 1);
  std::uint32_t place = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    offsets_[cell] = place;
    for (auto& of_part : next) place += std::exchange(of_part[cell], place);
  }
  offsets_[cells] = place;
  order_.resize(sites_.count);
  parallelFor(parts, 1, threads, [&](std::size_t part, std::size_t) {
    forPart(part, [&](std::size_t i, std::uint32_t cell) {
      order_[next[part][cell]++] = static_cast<std::uint32_t>(i);
    });
  });
}

void SiteCells::addUp() {
  const std::size_t across = std::size_t{lattice_.columns} + 1;
  sums_.assign(across * (lattice_.rows + std::size_t{1}), 0);
  for (std::size_t row = 0; row < lattice_.rows; ++row) {
    const auto* of_row = offsets_.data() + row * lattice_.columns;
    for (std::size_t column = 0; column < lattice_.columns; ++column) {
      sums_[(row + 1) * across + column + 1] =
          sums_[row * across + column + 1] + (of_row[column + 1] - of_row[0]);
    }
  }
}

std::uint64_t SiteCells::count(const BinBlock& block) const {
  const std::size_t across = std::size_t{lattice_.columns} + 1;
  const auto sum = [&](std::size_t column, std::size_t row) { return sums_[row * across + column]; };
  const std::size_t east = block.east + std::size_t{1}, north = block.north + std::size_t{1};
  return (sum(east, north) - sum(block.west, north)) -
         (sum(east, block.south) - sum(block.west, block.south));
}

BinBlock SiteCells::binsOf(const BinBlock& block) const {
  return {block.west * bins_along, block.south * bins_along,
          std::min((block.east + 1) * bins_along, grid_.columns) - 1,
          std::min((block.north + 1) * bins_along, grid_.rows) - 1};
}

/// Returns a lower bound of the distance from a place in the domain to the sites of a block. Sites beyond the
/// grid are farther away than their cell.
double SiteCells::distanceTo(const BinBlock& block, Point from) const {
  constexpr double rounding = 1e-6;
  const double size = lattice_.size, slack = rounding * size;
  const auto beyond = [slack](double value, double low, double high) {
    return std::max({low - value, value - high, slack}) - slack;
  };
  return std::hypot(
      beyond(from.x, lattice_.xmin + block.west * size, lattice_.xmin + (block.east + 1.0) * size),
      beyond(from.y, lattice_.ymin + block.south * size, lattice_.ymin + (block.north + 1.0) * size));
}

void SiteCells::addNear(Point from, double within, std::size_t most,
                        const std::function<bool(std::uint32_t)>& wanted,
                        std::vector<std::uint32_t>& found) const {
  const auto all_found = found.size() + most;
  std::vector<BinBlock> pending{all()};
  while (!pending.empty() && found.size() < all_found) {
    const auto block = pending.back();
    pending.pop_back();
    if (count(block) == 0 || distanceTo(block, from) >= within) continue;
    if (binsIn(block) > 1) {
      auto [near, far] = halves(block);
      if (distanceTo(far, from) < distanceTo(near, from)) std::swap(near, far);
      pending.push_back(far);
      pending.push_back(near);
      continue;
    }
    addNearest(block, from, within, all_found, wanted, found);
  }
}

/// Does the same for one cell of the lattice, nearest first, until there are `all_found`.
void SiteCells::addNearest(const BinBlock& cell, Point from, double within, std::size_t all_found,
                           const std::function<bool(std::uint32_t)>& wanted,
                           std::vector<std::uint32_t>& found) const {
  std::vector<std::pair<double, std::uint32_t>> near;
  eachRow(cell, [&](std::span<const std::uint32_t> sites) {
    for (const auto site : sites) {
      const Point p = place(site);
      const double dx = p.x - from.x, dy = p.y - from.y, squared = dx * dx + dy * dy;
      if (squared < within * within && wanted(site)) near.emplace_back(squared, site);
    }
  });
  const auto count = std::min(all_found - found.size(), near.size());
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
  for (std::size_t k = 0; k < count; ++k) found.push_back(near[k].second);
}

}  // namespace vorpipe::core
