#include "globe/sphere_mesh.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "base/try.h"
#include "domain/cells_run.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t sphere_grain = std::size_t{1} << 14;

/// The outermost sites in 14 directions, and the heaviest; the same for any order of the sites.
std::vector<std::uint32_t> outermost(const SphereSites& sites) {
  constexpr std::array<Direction, 14> ways{{{0, 0, -1},
                                            {0, 0, 1},
                                            {0, -1, 0},
                                            {0, 1, 0},
                                            {-1, 0, 0},
                                            {1, 0, 0},
                                            {-1, -1, -1},
                                            {1, -1, -1},
                                            {-1, 1, -1},
                                            {1, 1, -1},
                                            {-1, -1, 1},
                                            {1, -1, 1},
                                            {-1, 1, 1},
                                            {1, 1, 1}}};
  const auto vectors = sites.vectors();
  std::vector<std::uint32_t> found(ways.size());
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      const double of_a = dot(ways[k], vectors[a]), of_b = dot(ways[k], vectors[b]);
      return of_a != of_b ? of_a > of_b : vectors[a] < vectors[b];
    };
    for (std::uint32_t i = 1; i < vectors.size(); ++i) {
      if (before(i, found[k])) found[k] = i;
    }
  }
  const auto& excess = sites.excess;
  if (excess.empty()) return found;
  found.push_back(static_cast<std::uint32_t>(std::ranges::max_element(excess) - excess.begin()));
  return found;
}

/// A site to project from: of some, the one whose plane the others are farthest below. Where one is near, the
/// plane becomes wide. The heaviest has all others below it, save those with which it coincides.
std::uint32_t centerOf(const SphereSites& sites) {
  std::uint32_t best = 0;
  double farthest = -std::numeric_limits<double>::infinity();
  for (const auto candidate : outermost(sites)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < sites.direction.size(); ++i) {
      const double depth = depthOf(sites, candidate, i);
      // A site in the same direction is hidden, unless it is heavier.
      const bool is_same = sites.direction[i] == sites.direction[candidate];
      if (!is_same || depth < 0) nearest = std::min(nearest, depth);
    }
    if (nearest > farthest) {
      farthest = nearest;
      best = candidate;
    }
  }
  return best;
}

/// The sites in the plane, seen from outside of the sphere: without those in the direction of the center.
struct PlaneSites {
  Sites sites;
  std::vector<std::uint32_t> site;  ///< by site in the plane
};

PlaneSites projectFrom(std::uint32_t from, const SphereSites& sites, int threads) {
  const Direction& center = sites.direction[from];
  PlaneSites plane;
  for (std::uint32_t i = 0; i < sites.direction.size(); ++i) {
    if (sites.direction[i] != center) plane.site.push_back(i);
  }
  const auto count = plane.site.size();
  plane.sites.x.resize(count);
  plane.sites.y.resize(count);
  if (!sites.excess.empty()) plane.sites.weight.resize(count);
  const double own = sites.excessOf(from);
  const Direction right = perpendicular(center), up = cross(right, center);
  parallelFor(count, sphere_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto k = begin; k < end; ++k) {
      const auto site = plane.site[k];
      const double depth = depthOf(sites, from, site);
      const double excess = sites.excessOf(site), scale = (1 + excess) / depth;
      const Direction way = sites.direction[site] - center;
      plane.sites.x[k] = scale * dot(right, way);
      plane.sites.y[k] = scale * dot(up, way);
      if (plane.sites.weight.empty()) continue;
      const double lack = own - excess, squared = dot(way, way);
      plane.sites.weight[k] = ((1 + excess) * squared * own - lack * (2 - lack)) / (depth * depth);
    }
  });
  return plane;
}

/// Adds the triangles between the hull of those in the plane and the center. A site is on the hull if its
/// triangles leave a gap: the first site around it is then not also the last.
void closeAround(std::uint32_t center, std::vector<std::array<std::uint32_t, 3>>& triangles,
                 std::size_t sites) {
  std::vector<std::uint32_t> ends(sites);  // the first site around it, exclusive or the last
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) ends[t[k]] ^= t[(k + 1) % 3] ^ t[(k + 2) % 3];
  }
  std::vector<std::array<std::uint32_t, 2>> directed;
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = t[k], b = t[(k + 1) % 3];
      if (ends[a] != 0 && ends[b] != 0) directed.push_back({a, b});
    }
  }
  std::ranges::sort(directed);
  for (const auto& [a, b] : directed) {
    if (std::ranges::binary_search(directed, std::array{b, a})) continue;
    std::array<std::uint32_t, 3> t{b, a, center};
    std::ranges::rotate(t, std::ranges::min_element(t));
    triangles.push_back(t);
  }
}

/// Drops sites on a line, given in order, that weights hide: those above the lower hull of x^2 + y^2 - w.
void dropHidden(const Sites& sites, std::vector<std::uint32_t>& order) {
  const auto first = order.front();
  const auto along = [&](std::uint32_t k) {
    return std::hypot(sites.x[k] - sites.x[first], sites.y[k] - sites.y[first]);
  };
  const auto height = [&](std::uint32_t k) { return along(k) * along(k) - sites.weight[k]; };
  std::size_t kept = 0;
  for (const auto k : order) {
    while (kept >= 2) {
      const auto a = order[kept - 2], b = order[kept - 1];
      if ((height(b) - height(a)) * (along(k) - along(b)) < (height(k) - height(b)) * (along(b) - along(a)))
        break;
      --kept;
    }
    order[kept++] = k;
  }
  order.resize(kept);
}

/// Sites on a line of the plane that have cells, in order: on the sphere they follow each other around a
/// circle.
std::vector<std::uint32_t> alongLine(const PlaneSites& plane, const std::vector<std::uint32_t>& owner) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t k = 0; k < plane.site.size(); ++k) {
    if (owner[plane.site[k]] == plane.site[k]) order.push_back(k);
  }
  const auto& [x, y, weight] = plane.sites;
  std::ranges::sort(order, {}, [&](auto k) { return std::pair(x[k], y[k]); });
  if (!weight.empty()) dropHidden(plane.sites, order);
  for (auto& k : order) k = plane.site[k];
  return order;
}

}  // namespace

Result<SphereMesh> triangulateSphere(const Machine& machine, const SphereSites& sites,
                                     const CellsOptions& options, Report& report) {
  const auto& directions = sites.direction;
  SphereMesh mesh;
  mesh.owner.resize(directions.size());
  std::iota(mesh.owner.begin(), mesh.owner.end(), 0u);
  const auto center = centerOf(sites);
  const PlaneSites plane = projectFrom(center, sites, machine.threads);
  for (std::uint32_t i = 0; i < directions.size(); ++i) {
    if (directions[i] == directions[center]) mesh.owner[i] = center;
  }
  if (!plane.site.empty()) {
    CellsOptions in_plane;
    in_plane.domain = domainOf(plane.sites);
    in_plane.search = options.search;
    in_plane.progress = options.progress;
    VORPIPE_VAR(found, cellsOn(machine, plane.sites, in_plane));
    for (std::size_t k = 0; k < plane.site.size(); ++k) {
      mesh.owner[plane.site[k]] = plane.site[found.owner[k]];
    }
    mesh.triangles = std::move(found.triangles);
    for (auto& t : mesh.triangles) {
      for (auto& corner : t) corner = plane.site[corner];
    }
    report = std::move(found.report);
  }
  if (mesh.triangles.empty()) {
    mesh.circle = alongLine(plane, mesh.owner);
    mesh.circle.push_back(center);
  } else {
    closeAround(center, mesh.triangles, directions.size());
  }
  return mesh;
}

}  // namespace vorpipe::core
