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

/// The outermost sites in 14 directions; the same for any order of the sites.
std::array<std::uint32_t, 14> outermost(std::span<const Direction> sites) {
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
  std::array<std::uint32_t, 14> found{};
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      const double of_a = dot(ways[k], sites[a]), of_b = dot(ways[k], sites[b]);
      return of_a != of_b ? of_a > of_b : sites[a] < sites[b];
    };
    for (std::uint32_t i = 1; i < sites.size(); ++i) {
      if (before(i, found[k])) found[k] = i;
    }
  }
  return found;
}

/// A site to project from: of some, the one farthest from the next site. A near one would make the plane
/// wide.
std::uint32_t centerOf(std::span<const Direction> sites) {
  std::uint32_t best = 0;
  double farthest = -1;
  for (const auto candidate : outermost(sites)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Direction& site : sites) {
      const Direction way = site - sites[candidate];
      const double squared = dot(way, way);
      if (squared > 0) nearest = std::min(nearest, squared);
    }
    if (nearest > farthest) {
      farthest = nearest;
      best = candidate;
    }
  }
  return best;
}

/// The sites in the plane, seen from outside of the sphere: without those that coincide with the center.
struct PlaneSites {
  Sites sites;
  std::vector<std::uint32_t> site;  ///< by site in the plane
};

PlaneSites projectFrom(const Direction& center, std::span<const Direction> sites, int threads) {
  PlaneSites plane;
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (sites[i] != center) plane.site.push_back(i);
  }
  const auto count = plane.site.size();
  plane.sites.x.resize(count);
  plane.sites.y.resize(count);
  const Direction right = perpendicular(center), up = cross(right, center);
  parallelFor(count, sphere_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto k = begin; k < end; ++k) {
      const Direction way = sites[plane.site[k]] - center;
      const double half = dot(way, way) / 2;
      plane.sites.x[k] = dot(right, way) / half;
      plane.sites.y[k] = dot(up, way) / half;
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

/// Sites on a line of the plane, in order: on the sphere they follow each other around a circle.
std::vector<std::uint32_t> alongLine(const PlaneSites& plane, const std::vector<std::uint32_t>& owner) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t k = 0; k < plane.site.size(); ++k) {
    if (owner[plane.site[k]] == plane.site[k]) order.push_back(k);
  }
  std::ranges::sort(order, {}, [&](auto k) { return std::pair(plane.sites.x[k], plane.sites.y[k]); });
  for (auto& k : order) k = plane.site[k];
  return order;
}

}  // namespace

Result<SphereMesh> triangulateSphere(const Machine& machine, std::span<const Direction> sites,
                                     const CellsOptions& options, Report& report) {
  SphereMesh mesh;
  mesh.owner.resize(sites.size());
  std::iota(mesh.owner.begin(), mesh.owner.end(), 0u);
  const auto center = centerOf(sites);
  const PlaneSites plane = projectFrom(sites[center], sites, machine.threads);
  const auto first = static_cast<std::uint32_t>(std::ranges::find(sites, sites[center]) - sites.begin());
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (sites[i] == sites[center]) mesh.owner[i] = first;
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
    mesh.circle.push_back(first);
  } else {
    closeAround(first, mesh.triangles, sites.size());
  }
  return mesh;
}

}  // namespace vorpipe::core
