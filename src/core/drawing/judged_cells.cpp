#include "core/drawing/judged_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "core/geometry/vertex_position.h"
#include "core/search/bisectors.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t grain = 512;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Calls each(p) for the corners of a cell, seen from its origin: far from where coordinates begin, a corner
/// need not be one of them. A corner that rounding moved out of the domain lies on its wall.
template <class Each>
void forCorners(const SiteSet& sites, std::uint32_t site, std::span<const std::int32_t> neighbors,
                const Each& each) {
  const Point origin = cellOrigin(sites, site);
  const Box domain = domainFrom(sites, origin);
  for (std::size_t k = 0; k < neighbors.size(); ++k) {
    const auto before = neighbors[k > 0 ? k - 1 : neighbors.size() - 1];
    const auto p =
        relativeTo(origin, cornerPosition(sites, static_cast<std::int32_t>(site), before, neighbors[k]));
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    each(Point{std::clamp(p.x, domain.xmin, domain.xmax), std::clamp(p.y, domain.ymin, domain.ymax)});
  }
}

/// Of the cell, seen from its origin. The domain for one whose corners are not numbers.
Box boundingBox(const SiteSet& sites, std::uint32_t site, std::span<const std::int32_t> neighbors) {
  Box box{infinite, infinite, -infinite, -infinite};
  forCorners(sites, site, neighbors, [&](Point p) {
    box = {std::min(box.xmin, p.x), std::min(box.ymin, p.y), std::max(box.xmax, p.x),
           std::max(box.ymax, p.y)};
  });
  return box.xmin <= box.xmax ? box : domainFrom(sites, cellOrigin(sites, site));
}

/// The sites among the neighbors, nearest first, into `out`.
void sortByDistance(const SiteSet& sites, std::uint32_t site, std::span<const std::int32_t> neighbors,
                    std::uint32_t* out) {
  struct Away {
    double distance;
    std::uint32_t site;
  };
  std::vector<Away> others;
  for (const auto neighbor : neighbors) {
    if (neighbor < 0) continue;
    const auto other = static_cast<std::uint32_t>(neighbor);
    others.push_back({std::hypot(sites.x[other] - sites.x[site], sites.y[other] - sites.y[site]), other});
  }
  std::sort(others.begin(), others.end(), [](const Away& a, const Away& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.site < b.site;
  });
  for (const auto& other : others) *out++ = other.site;
}

}  // namespace

Candidates boundaries(const SiteSet& sites, const JudgedCells& cells, std::span<const std::uint32_t> entries,
                      int threads) {
  Candidates list;
  list.site.resize(entries.size());
  list.walls.resize(entries.size());
  list.reach.assign(entries.size(), infinite);
  list.offsets.resize(entries.size() + 1);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto around = cells.found.edges(entries[k]);
    const auto others = std::count_if(around.begin(), around.end(), [](std::int32_t n) { return n >= 0; });
    list.offsets[k + 1] = list.offsets[k] + static_cast<std::uint32_t>(others);
  }
  list.index.resize(list.offsets.back());
  parallelFor(entries.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto k = begin; k < end; ++k) {
      const auto site = cells.which[entries[k]];
      const auto around = cells.found.edges(entries[k]);
      list.site[k] = site;
      list.walls[k] = boundingBox(sites, site, around);
      sortByDistance(sites, site, around, list.index.data() + list.offsets[k]);
    }
  });
  return list;
}

std::vector<Point> cellPolygon(const SiteSet& sites, std::uint32_t site,
                               std::span<const std::int32_t> neighbors) {
  std::vector<Point> polygon;
  forCorners(sites, site, neighbors, [&](Point p) { polygon.push_back(p); });
  return polygon;
}

}  // namespace vorpipe::core
