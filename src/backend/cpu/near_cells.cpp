#include "backend/cpu/near_cells.h"

#include <algorithm>

#include "backend/collect.h"
#include "base/parallel.h"

namespace vorpipe::cpu {
namespace {

/// Bins on each side of the cell's own whose sites are tried. The first number is enough for nearly all cells
/// of evenly spread sites, the second for those that reach farther, say to the domain's border.
constexpr std::int64_t bins_around[] = {4, 16};
/// The most sites in the bins that are tried; evenly spread ones are about 2200 in 33 x 33 bins.
constexpr std::size_t most_near_sites = 8192;
constexpr std::size_t near_cells_grain = 8;

struct Bins {
  std::int64_t west, south, east, north;
};

std::int64_t binAlong(double at, double low, double size, std::uint32_t count) {
  const double bin = std::clamp((at - low) / size, 0.0, static_cast<double>(count - 1));
  return static_cast<std::int64_t>(bin);
}

Bins binsAround(const SiteSet& sites, std::uint32_t site, std::int64_t reach) {
  const auto& grid = sites.grid;
  const auto x = std::clamp(sites.x[site], sites.domain.xmin, sites.domain.xmax);
  const auto y = std::clamp(sites.y[site], sites.domain.ymin, sites.domain.ymax);
  const auto column = binAlong(x, grid.xmin, grid.size, grid.columns);
  const auto row = binAlong(y, grid.ymin, grid.size, grid.rows);
  return {std::max(column - reach, std::int64_t{0}), std::max(row - reach, std::int64_t{0}),
          std::min(column + reach, std::int64_t{grid.columns} - 1),
          std::min(row + reach, std::int64_t{grid.rows} - 1)};
}

/// Returns a box whose sites are all in the bins. It extends to the next bin or, at a border of the grid, as
/// far as the coverage of `sites`.
Box coverageIn(const SiteSet& sites, const Bins& bins) {
  const auto& grid = sites.grid;
  // A site may lie outside of its bin by the rounding of its coordinates.
  const auto edge = [&](double low, std::int64_t bin, double inward) {
    const double at = low + static_cast<double>(bin) * grid.size;
    return at + inward * 1e-6 * grid.size;
  };
  auto coverage = sites.coverage;
  if (bins.west > 0) coverage.xmin = std::max(coverage.xmin, edge(grid.xmin, bins.west, 1));
  if (bins.south > 0) coverage.ymin = std::max(coverage.ymin, edge(grid.ymin, bins.south, 1));
  if (bins.east + 1 < grid.columns)
    coverage.xmax = std::min(coverage.xmax, edge(grid.xmin, bins.east + 1, -1));
  if (bins.north + 1 < grid.rows)
    coverage.ymax = std::min(coverage.ymax, edge(grid.ymin, bins.north + 1, -1));
  return coverage;
}

void take(const SiteSet& sites, std::uint32_t i, SiteSet& near) {
  near.x.push_back(sites.x[i]);
  near.y.push_back(sites.y[i]);
  if (!sites.weight.empty()) near.weight.push_back(sites.weight[i]);
  near.id.push_back(i);
}

/// The sites of `bins` and all heavy ones; an empty set if the bins hold more than most_near_sites.
SiteSet sitesIn(const SiteSet& sites, const Bins& bins) {
  SiteSet near;
  near.domain = sites.domain;
  near.shorter_side = sites.shorter_side;
  near.coverage = coverageIn(sites, bins);
  if (!sites.weight.empty()) near.grid.heaviest = {sites.grid.heaviest.back()};
  auto heavy = sites.heavy;
  for (auto row = bins.south; row <= bins.north; ++row) {
    const auto first_bin = static_cast<std::size_t>(row * sites.grid.columns + bins.west);
    const auto last_bin = static_cast<std::size_t>(row * sites.grid.columns + bins.east);
    for (auto i = sites.grid.offsets[first_bin]; i < sites.grid.offsets[last_bin + 1]; ++i) {
      if (near.size() == most_near_sites) return {};
      if (std::erase(heavy, i) > 0) near.heavy.push_back(static_cast<std::uint32_t>(near.size()));
      take(sites, i, near);
    }
  }
  for (const auto i : heavy) {
    near.heavy.push_back(static_cast<std::uint32_t>(near.size()));
    take(sites, i, near);
  }
  return near;
}

/// Finds the cell of `site` among the sites up to `reach` bins away. Neighbors are indices in the whole set.
CellStatus findWithin(std::int64_t reach, const SiteSet& sites, std::uint32_t site, FindOverTree find,
                      std::vector<std::int32_t>& neighbors) {
  const auto near = sitesIn(sites, binsAround(sites, site, reach));
  const auto at = std::find(near.id.begin(), near.id.end(), site) - near.id.begin();
  const auto self = static_cast<std::uint32_t>(at);
  // The bins hold too many sites, or the site lies outside the domain, far from its cell.
  if (self == near.size()) return CellStatus::unsecured;
  CellNeighbors found;
  find(near, SiteTree(near, 1), {&self, 1}, 1, found);
  renumber(found, 0, [&](std::uint32_t index) { return near.id[index]; });
  neighbors.assign(found.neighbor.begin(), found.neighbor.end());
  return found.status[0];
}

CellStatus findOne(const SiteSet& sites, std::uint32_t site, FindOverTree find,
                   std::vector<std::int32_t>& neighbors) {
  auto status = CellStatus::unsecured;
  for (const auto reach : bins_around) {
    if (status == CellStatus::unsecured) status = findWithin(reach, sites, site, find, neighbors);
  }
  return status;
}

}  // namespace

void findNearby(const SiteSet& sites, std::span<const std::uint32_t> which, FindOverTree find, int threads,
                CellNeighbors& out) {
  std::vector<std::vector<std::int32_t>> neighbors(which.size());
  out.status.resize(which.size());
  parallelEach(which.size(), near_cells_grain, threads,
               [&](std::size_t e) { out.status[e] = findOne(sites, which[e], find, neighbors[e]); });
  out.offsets.assign(1, 0);
  out.neighbor.clear();
  for (const auto& some : neighbors) {
    out.neighbor.insert(out.neighbor.end(), some.begin(), some.end());
    out.offsets.push_back(out.neighbor.size());
  }
}

void replaceUnsecured(const CellNeighbors& anew, CellNeighbors& out) {
  CellNeighbors all;
  all.status = out.status;
  all.offsets.assign(1, 0);
  std::size_t next = 0;
  const auto append = [&](const CellNeighbors& from, std::size_t e) {
    all.neighbor.insert(all.neighbor.end(),
                        from.neighbor.begin() + static_cast<std::ptrdiff_t>(from.offsets[e]),
                        from.neighbor.begin() + static_cast<std::ptrdiff_t>(from.offsets[e + 1]));
  };
  for (std::size_t e = 0; e < out.status.size(); ++e) {
    if (out.status[e] == CellStatus::unsecured) {
      all.status[e] = anew.status[next];
      append(anew, next++);
    } else {
      append(out, e);
    }
    all.offsets.push_back(all.neighbor.size());
  }
  out = std::move(all);
}

}  // namespace vorpipe::cpu
