#include "globe/sphere_mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"
#include "cells/site_mesh.h"
#include "sites/site_set.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t sphere_grain = std::size_t{1} << 14;

/// The outermost sites in 14 directions, and the heaviest; the same for any order of the sites.
std::vector<std::uint32_t> outermost(const SphereSites& sites, int threads) {
  static constexpr std::array<Direction, 14> ways{{{0, 0, -1},
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
  /// The first in each direction, and how far it is.
  struct Outermost {
    std::array<std::uint32_t, ways.size()> site{};
    std::array<double, ways.size()> height{};
  };
  const auto take = [&](Outermost& of, std::size_t k, std::uint32_t i, double height) {
    if (height < of.height[k] || (height == of.height[k] && !(vectors[i] < vectors[of.site[k]]))) return;
    of.site[k] = i;
    of.height[k] = height;
  };
  std::vector<Outermost> blocks((vectors.size() + sphere_grain - 1) / sphere_grain);
  parallelFor(vectors.size(), sphere_grain, threads, [&](std::size_t begin, std::size_t end) {
    Outermost here;
    here.height.fill(-std::numeric_limits<double>::infinity());
    for (auto i = begin; i < end; ++i) {
      for (std::size_t k = 0; k < ways.size(); ++k) {
        take(here, k, static_cast<std::uint32_t>(i), dot(ways[k], vectors[i]));
      }
    }
    blocks[begin / sphere_grain] = here;
  });
  Outermost all = blocks.front();
  for (const Outermost& block : blocks) {
    for (std::size_t k = 0; k < ways.size(); ++k) take(all, k, block.site[k], block.height[k]);
  }
  std::vector<std::uint32_t> found(all.site.begin(), all.site.end());
  const auto& excess = sites.excess;
  if (excess.empty()) return found;
  found.push_back(static_cast<std::uint32_t>(std::ranges::max_element(excess) - excess.begin()));
  return found;
}

/// A site to project from: of some, the one whose plane the others are farthest below. Where one is near, the
/// plane becomes wide. The heaviest has all others below it, save those with which it coincides.
std::uint32_t centerOf(const SphereSites& sites, int threads) {
  const auto candidates = outermost(sites, threads);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<double> nearest(candidates.size(), infinite);
  std::mutex merging;
  parallelFor(sites.direction.size(), sphere_grain, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<double> here(candidates.size(), infinite);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const auto candidate = candidates[k];
      for (auto i = begin; i < end; ++i) {
        const double depth = depthOf(sites, candidate, i);
        if (!(depth < here[k])) continue;
        // A site in the same direction is hidden, unless it is heavier.
        if (depth < 0 || sites.direction[i] != sites.direction[candidate]) here[k] = depth;
      }
    }
    const std::scoped_lock lock(merging);
    std::ranges::transform(here, nearest, nearest.begin(), [](double a, double b) { return std::min(a, b); });
  });
  return candidates[static_cast<std::size_t>(std::ranges::max_element(nearest) - nearest.begin())];
}

/// Axes along which a direction has no negative part, the largest first. In these coordinates all is rounded
/// alike, however a cube's rotation turns the sites.
class AxesOf {
 public:
  explicit AxesOf(const Direction& direction) {
    const std::array parts{direction.x, direction.y, direction.z};
    std::ranges::sort(order_, std::greater{}, [&](std::size_t k) { return std::abs(parts[k]); });
    for (std::size_t k = 0; k < 3; ++k) sign_[k] = std::copysign(1, parts[order_[k]]);
    const bool is_even = order_[1] == (order_[0] + 1) % 3;
    handedness_ = sign_[0] * sign_[1] * sign_[2] * (is_even ? 1 : -1);
  }

  Direction operator()(const Direction& a) const {
    const std::array parts{a.x, a.y, a.z};
    return {sign_[0] * parts[order_[0]], sign_[1] * parts[order_[1]], sign_[2] * parts[order_[2]]};
  }
  /// 1 if they are right-handed, else -1.
  [[nodiscard]] double handedness() const { return handedness_; }

 private:
  std::array<std::size_t, 3> order_{0, 1, 2};
  std::array<double, 3> sign_{};
  double handedness_;
};

/// The sites in the plane, seen from outside of the sphere: without those in the direction of the center.
struct PlaneSites {
  Sites sites;
  std::vector<std::uint32_t> site;  ///< by site in the plane
};

PlaneSites projectFrom(std::uint32_t from, const SphereSites& sites, int threads) {
  const Direction& center = sites.direction[from];
  const auto all = sites.direction.size();
  PlaneSites plane;
  // At the same time: the time goes into pages.
  const std::array<std::function<void()>, 3> tasks{[&] {
                                                     plane.site.reserve(all);
                                                     for (std::uint32_t i = 0; i < all; ++i) {
                                                       if (sites.direction[i] != center)
                                                         plane.site.push_back(i);
                                                     }
                                                   },
                                                   [&] { plane.sites.x.resize(all); },
                                                   [&] { plane.sites.y.resize(all); }};
  parallelEach(tasks.size(), 1, threadsForSteps(all, threads), [&](std::size_t k) { tasks[k](); });
  const auto count = plane.site.size();
  plane.sites.x.resize(count);
  plane.sites.y.resize(count);
  if (!sites.excess.empty()) plane.sites.weight.resize(count);
  const double own = sites.excessOf(from);
  const AxesOf axes(center);
  const Direction right = perpendicular(axes(center)), up = axes.handedness() * cross(right, axes(center));
  parallelFor(count, sphere_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto k = begin; k < end; ++k) {
      const auto site = plane.site[k];
      const Direction way = axes(sites.direction[site] - center);
      const double excess = sites.excessOf(site);
      const double depth = own - excess + (1 + excess) * dot(way, way) / 2, scale = (1 + excess) / depth;
      plane.sites.x[k] = scale * dot(right, way);
      plane.sites.y[k] = scale * dot(up, way);
      if (plane.sites.weight.empty()) continue;
      const double lack = own - excess, squared = dot(way, way);
      plane.sites.weight[k] = ((1 + excess) * squared * own - lack * (2 - lack)) / (depth * depth);
    }
  });
  return plane;
}

/// Sites of the plane that are out of the range of exact decisions.
Error tooNear() {
  return refusalOf(Subject::sites, "they are too many, or too near to each other, for one triangulation");
}

/// Triangulates the plane's sites. What is beyond their hull lies between it and the center.
Result<void> closeAround(std::uint32_t center, const PlaneSites& plane, const SiteSet& set, int threads,
                         SphereMesh& mesh) {
  if (!canTriangulate(set)) return tl::unexpected(tooNear());
  PartMesh part = triangulate(set, allOf(set), threads);
  mesh.triangles = std::move(part.mesh.triangles);
  if (mesh.triangles.empty()) return {};
  mesh.site = std::move(part.site);
  parallelEach(mesh.site.size(), sphere_grain, threads,
               [&](std::size_t v) { mesh.site[v] = plane.site[set.id[mesh.site[v]]]; });
  mesh.at = std::move(part.mesh.at);
  const auto of_center = static_cast<std::int32_t>(mesh.site.size());
  mesh.site.push_back(center);
  mesh.at.push_back(-1);
  std::atomic<std::int32_t> beside_center = -1;
  parallelEach(mesh.triangles.size(), sphere_grain, threads, [&](std::size_t t) {
    for (auto& corner : mesh.triangles[t].corner) {
      if (corner != ghost) continue;
      corner = of_center;
      beside_center = static_cast<std::int32_t>(t);  // any will do
    }
  });
  mesh.at.back() = beside_center;
  if (set.weight.empty()) return {};
  for (std::size_t v = 0; v < mesh.at.size(); ++v) {
    const auto& corner = mesh.triangles[static_cast<std::size_t>(mesh.at[v])].corner;
    if (std::ranges::find(corner, static_cast<std::int32_t>(v)) == corner.end()) mesh.at[v] = -1;
  }
  return {};
}

/// A hidden site in the direction of one with a cell is its duplicate.
void ownHidden(const SphereSites& sites, SphereMesh& mesh) {
  if (sites.excess.empty()) return;
  std::vector<std::uint8_t> has_cell(sites.direction.size());
  for (const auto site : mesh.circle) has_cell[site] = 1;
  for (std::size_t v = 0; v < mesh.at.size(); ++v) {
    if (mesh.at[v] >= 0) has_cell[mesh.site[v]] = 1;
  }
  const auto directionAt = [&](std::uint32_t site) { return sites.direction[site]; };
  std::vector<std::uint32_t> hidden;
  for (std::uint32_t i = 0; i < has_cell.size(); ++i) {
    if (has_cell[i] == 0 && mesh.owner[i] == i) hidden.push_back(i);
  }
  std::ranges::sort(hidden, {}, directionAt);
  for (std::uint32_t i = 0; i < has_cell.size(); ++i) {
    if (has_cell[i] == 0) continue;
    const auto last = std::ranges::upper_bound(hidden, directionAt(i), {}, directionAt);
    for (auto at = std::ranges::lower_bound(hidden, directionAt(i), {}, directionAt); at != last; ++at)
      mesh.owner[*at] = i;
  }
  for (auto& owner : mesh.owner) owner = mesh.owner[owner];
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
  const Sites& sites = plane.sites;
  std::ranges::sort(order, {}, [&](auto k) { return std::pair(sites.x[k], sites.y[k]); });
  if (!sites.weight.empty()) dropHidden(sites, order);
  for (auto& k : order) k = plane.site[k];
  return order;
}

}  // namespace

Result<SphereMesh> triangulateSphere(const SphereSites& sites, int threads) {
  const auto& directions = sites.direction;
  SphereMesh mesh;
  mesh.owner.resize(directions.size());
  std::iota(mesh.owner.begin(), mesh.owner.end(), 0u);
  const auto center = centerOf(sites, threads);
  const PlaneSites plane = projectFrom(center, sites, threads);
  for (std::uint32_t i = 0; i < directions.size(); ++i) {
    if (directions[i] == directions[center]) mesh.owner[i] = center;
  }
  if (!plane.site.empty()) {
    const auto prepared = prepareInOneBin(plane.sites, domainOf(plane.sites), threads);
    if (!prepared) return tl::unexpected(tooNear());
    parallelEach(plane.site.size(), sphere_grain, threads,
                 [&](std::size_t k) { mesh.owner[plane.site[k]] = plane.site[prepared->owner[k]]; });
    VORPIPE_TRY(closeAround(center, plane, prepared->set, threads, mesh));
  }
  if (mesh.triangles.empty()) {
    mesh.circle = alongLine(plane, mesh.owner);
    mesh.circle.push_back(center);
  }
  ownHidden(sites, mesh);
  return mesh;
}

}  // namespace vorpipe::core
