#include "core/dual.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vorpipe {
namespace {

struct Corner {
  std::uint64_t root;
  std::uint32_t cell;
  bool at_wall;
};

std::vector<Corner> cornersByVertex(const SiteSet& sites, const Topology& topology, const Corners& corners) {
  std::vector<Corner> all;
  all.reserve(topology.neighbor.size());
  for (std::uint32_t cell = 0; cell < sites.size(); ++cell) {
    const auto begin = topology.first[cell];
    const auto end = topology.first[cell + 1];
    for (auto e = begin; e < end; ++e) {
      const auto before = e > begin ? e - 1 : end - 1;
      all.push_back({corners.root[e], cell, topology.neighbor[e] < 0 || topology.neighbor[before] < 0});
    }
  }
  std::sort(all.begin(), all.end(), [](const Corner& a, const Corner& b) {
    return a.root != b.root ? a.root < b.root : a.cell < b.cell;
  });
  return all;
}

/// The input indices of cells around a vertex, counter-clockwise from the lowest.
std::vector<std::uint32_t> sitesAround(const SiteSet& sites, Point vertex, std::vector<std::uint32_t> cells) {
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  const auto angle = [&](std::uint32_t cell) {
    return std::atan2(sites.y[cell] - vertex.y, sites.x[cell] - vertex.x);
  };
  std::sort(cells.begin(), cells.end(), [&](auto a, auto b) { return angle(a) < angle(b); });
  std::transform(cells.begin(), cells.end(), cells.begin(), [&](auto cell) { return sites.id[cell]; });
  std::rotate(cells.begin(), std::min_element(cells.begin(), cells.end()), cells.end());
  return cells;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> dualTriangles(const SiteSet& sites, const Topology& topology,
                                                        const Corners& corners) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const auto all = cornersByVertex(sites, topology, corners);
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    std::vector<std::uint32_t> cells;
    bool at_wall = false;
    for (end = begin; end < all.size() && all[end].root == all[begin].root; ++end) {
      cells.push_back(all[end].cell);
      at_wall = at_wall || all[end].at_wall;
    }
    if (at_wall) continue;
    const auto around = sitesAround(sites, corners.position[all[begin].root], std::move(cells));
    for (std::size_t k = 2; k < around.size(); ++k)
      triangles.push_back({around[0], around[k - 1], around[k]});
  }
  return triangles;
}

}  // namespace vorpipe
