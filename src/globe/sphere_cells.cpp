#include "globe/sphere_cells.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "backend/tie.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t cells_grain = 4096;

/// The axis of a circle through sites: at right angles to the chords from the first, of which it takes those
/// that enclose the largest triangle.
Direction axisOf(std::span<const Direction> sites, const std::vector<std::uint32_t>& circle) {
  const Direction& from = sites[circle.front()];
  const auto chord = [&](std::uint32_t site) { return sites[site] - from; };
  const auto farthest =
      *std::ranges::max_element(circle, {}, [&](auto site) { return lengthOf(chord(site)); });
  const Direction along = chord(farthest);
  const auto widest =
      *std::ranges::max_element(circle, {}, [&](auto site) { return lengthOf(cross(along, chord(site))); });
  return normalized(cross(along, chord(widest)));
}

/// The cells of sites on one circle: slices that meet at its two poles.
class Slices {
 public:
  Slices(const SphereSites& sites, const std::vector<std::uint32_t>& circle, const Direction& axis)
      : sites_(sites), vectors_(sites.vectors()), circle_(circle), axis_(axis) {}

  /// The axis at one of whose ends the sole vertex of two sites' edge is; or around which the sites lie.
  static Direction axisOf(std::span<const Direction> sites, const std::vector<std::uint32_t>& circle) {
    if (circle.size() < 2) return {0, 0, 0};
    if (circle.size() > 2) return core::axisOf(sites, circle);
    const auto [low, high] = std::minmax(circle[0], circle[1]);
    return perpendicular(normalized(sites[low] - sites[high]));
  }

  void visit(std::size_t begin, std::size_t end, bool has_places,
             const std::function<void(const SphereCell&)>& work) const {
    for (auto k = begin; k < end; ++k) {
      const Slice slice = sliceOf(k);
      std::array<Point, 2> place{};
      const std::span vertex(slice.vertex.data(), slice.edges);
      if (has_places) std::ranges::transform(vertex, place.begin(), placeOf);
      work({circle_[k],
            sites_.direction[circle_[k]],
            {slice.neighbor.data(), slice.edges},
            vertex,
            {place.data(), has_places ? slice.edges : 0}});
    }
  }

 private:
  struct Slice {
    std::size_t edges;
    std::array<std::int64_t, 2> neighbor;
    std::array<Direction, 2> vertex;
  };

  [[nodiscard]] Slice sliceOf(std::size_t k) const {
    const auto count = circle_.size();
    if (count == 1) return {};
    if (count == 2) return {1, {circle_[1 - k]}, {axis_}};
    const auto site = circle_[k];
    std::array around{circle_[k > 0 ? k - 1 : count - 1], circle_[k + 1 < count ? k + 1 : 0]};
    std::ranges::sort(around);
    Slice slice{2, {around[0], around[1]}, {}};
    for (std::size_t e = 0; e < 2; ++e) {
      // Around the site, the edge runs counter-clockwise about the way from its neighbor.
      const Direction turn =
          cross(vectors_[site] - vectors_[around[e]], vectors_[site] - vectors_[around[1 - e]]);
      slice.vertex[e] = dot(turn, axis_) > 0 ? -axis_ : axis_;
    }
    return slice;
  }

  const SphereSites& sites_;
  std::span<const Direction> vectors_;
  const std::vector<std::uint32_t>& circle_;
  Direction axis_;
};

/// A triangle around a vertex of a mesh, and the vertex after it there, counter-clockwise. The edge to that
/// vertex begins in the triangle before.
struct MeshCorner {
  std::uint32_t triangle, first;
};

constexpr std::uint32_t no_corner = ~std::uint32_t{0};

/// Lists the triangles, by `root`, around a vertex whose edges are no ties, counter-clockwise.
void listAround(const SphereMesh& mesh, const std::vector<std::uint32_t>& root, std::uint32_t v,
                std::vector<MeshCorner>& around) {
  around.clear();
  const auto begin = mesh.at[v];
  if (begin < 0) return;
  const auto own = static_cast<std::int32_t>(v);
  auto t = begin;
  std::uint32_t before = no_corner;
  do {
    const MeshTriangle& triangle = mesh.triangles[static_cast<std::size_t>(t)];
    const auto& corner = triangle.corner;
    // The corner after its own, without a jump that no processor would foresee.
    const auto next = std::size_t{corner[0] == own} + 2 * std::size_t{corner[1] == own};
    before = root[static_cast<std::size_t>(t)];
    around.push_back({before, static_cast<std::uint32_t>(corner[next])});
    t = triangle.neighbor[next];
  } while (t != begin);
  // From here, `triangle` is the one where the edge begins.
  std::size_t kept = 0;
  for (const MeshCorner corner : around) {
    if (corner.triangle != before) around[kept++] = {before, corner.first};
    before = corner.triangle;
  }
  around.resize(kept);
}

/// A triangle's corners from the lowest: the same however the mesh was made.
std::array<std::int32_t, 3> fromLowest(std::array<std::int32_t, 3> corner) {
  const auto [a, b, c] = corner;
  if (b < a && b < c) return {b, c, a};
  if (c < a && c < b) return {c, a, b};
  return corner;
}

}  // namespace

/// Finds the cells of a mesh's sites. Vertices of the mesh lie along a curve, so what is by vertex here is
/// too.
class CellRows {
 public:
  CellRows(const SphereSites& sites, const SphereMesh& mesh, int threads)
      : mesh_(mesh),
        threads_(threads),
        sites_(along(sites)),
        vectors_(sites_.vectors()),
        cells_(sites, mesh),
        joined_(mesh.triangles.size()) {}

  Result<SphereCells> run(std::size_t sites, bool has_places) {
    VORPIPE_TRY(findCenters());
    each(mesh_.triangles.size(), [this](std::uint32_t t) { joinTies(t); });
    cells_.root_ = std::move(joined_).roots();
    settleCenters();
    VORPIPE_TRY(count(sites));
    if (has_places) findPlaces();
    cells_.along_ = std::move(sites_.direction);
    return std::move(cells_);
  }

  static SphereCells ofCircle(const SphereSites& sites, const SphereMesh& mesh, bool has_places) {
    SphereCells cells(sites, mesh);
    const auto& circle = mesh.circle;
    cells.axis_ = Slices::axisOf(sites.vectors(), circle);
    cells.places_.resize(has_places ? 1 : 0);
    cells.offsets.assign(sites.direction.size() + 1, 0);
    for (const auto site : circle)
      cells.offsets[site + std::size_t{1}] = std::min<std::size_t>(circle.size() - 1, 2);
    std::partial_sum(cells.offsets.begin(), cells.offsets.end(), cells.offsets.begin());
    return cells;
  }

 private:
  using Center = SphereCells::Center;

  template <class Work>
  void each(std::size_t count, const Work& work) {
    parallelFor(count, cells_grain, threads_, [&](std::size_t begin, std::size_t end) {
      for (auto k = begin; k < end; ++k) work(static_cast<std::uint32_t>(k));
    });
  }

  SphereSites along(const SphereSites& sites) {
    SphereSites ordered;
    const auto take = [&](const auto& from, auto& to) {
      if (from.empty()) return;
      to.resize(mesh_.site.size());
      each(to.size(), [&](std::uint32_t v) { to[v] = from[mesh_.site[v]]; });
    };
    take(sites.direction, ordered.direction);
    take(sites.excess, ordered.excess);
    take(sites.scaled, ordered.scaled);
    return ordered;
  }

  /// At right angles to the plane through the three vectors. Near a site it is that site's direction p plus
  /// the part of a vector at right angles to that plane: (p + u) . (v - w) = 0 for its vector v and both
  /// others, w. That keeps the digits of sites that are near to each other.
  [[nodiscard]] Center centerOf(const std::array<std::int32_t, 3>& corner) const {
    constexpr double few = 8, near = 0.5, epsilon = std::numeric_limits<double>::epsilon();
    const std::array t{static_cast<std::size_t>(corner[0]), static_cast<std::size_t>(corner[1]),
                       static_cast<std::size_t>(corner[2])};
    const Direction a = vectors_[t[1]] - vectors_[t[0]], b = vectors_[t[2]] - vectors_[t[0]];
    const Direction across = cross(a, b);
    const double size = lengthOf(across), longest = std::max(lengthOf(a), lengthOf(b));
    const auto depth = [&](std::size_t site) { return depthOf(sites_, t[0], site); };
    const Direction way =
        1 / (size * size) * (depth(t[1]) * cross(b, across) + depth(t[2]) * cross(across, a));
    const double radius = lengthOf(way);
    if (radius < near && dot(sites_.direction[t[0]], across) > 0) {
      return {normalized(sites_.direction[t[0]] + way),
              few * epsilon * (1 + (longest + radius) * longest / size)};
    }
    return {1 / size * across, few * epsilon * longest / size};
  }

  Result<void> findCenters() {
    auto& centers = cells_.centers_;
    centers.resize(mesh_.triangles.size());
    std::atomic<std::uint32_t> lost = no_site;
    each(centers.size(), [&](std::uint32_t t) {
      const auto corner = fromLowest(mesh_.triangles[t].corner);
      centers[t] = centerOf(corner);
      if (std::isfinite(lengthOf(centers[t].at))) return;
      const auto site = mesh_.site[static_cast<std::size_t>(corner[0])];
      auto lowest = lost.load();
      while (site < lowest && !lost.compare_exchange_weak(lowest, site)) {
      }
    });
    if (lost == no_site) return {};
    return tl::unexpected(refusalOf(
        Subject::sites,
        fmt::format("site {} is so near to others that rounding leaves no vertex to them", lost.load())));
  }

  /// Joins a triangle with those across its edges that are ties, and of higher numbers.
  void joinTies(std::uint32_t t) {
    const MeshTriangle& triangle = mesh_.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto next = static_cast<std::uint32_t>(triangle.neighbor[k]);
      if (next < t) continue;
      const Center &a = cells_.centers_[t], &b = cells_.centers_[next];
      const Direction sides = vectorAt(triangle.corner[(k + 1) % 3]) - vectorAt(triangle.corner[(k + 2) % 3]);
      const double tie = std::max(shortest_edge * lengthOf(sides), a.rounding + b.rounding);
      const Direction way = b.at - a.at;
      if (dot(way, way) <= tie * tie) joined_.join(t, next);
    }
  }

  /// Centers that ties join are where the one is that rounding moves least.
  void settleCenters() {
    auto& centers = cells_.centers_;
    const auto& root = cells_.root_;
    const auto count = static_cast<std::uint32_t>(centers.size());
    std::vector<std::uint32_t> tied;
    for (std::uint32_t t = 0; t < count; ++t) {
      if (root[t] != t) tied.push_back(t);
    }
    if (tied.empty()) return;
    std::vector<std::uint32_t> best(count);
    each(count, [&](std::uint32_t t) { best[t] = t; });
    const auto isBetter = [&](std::uint32_t a, std::uint32_t b) {
      if (centers[a].rounding != centers[b].rounding) return centers[a].rounding < centers[b].rounding;
      return fromLowest(mesh_.triangles[a].corner) < fromLowest(mesh_.triangles[b].corner);
    };
    for (const auto t : tied) {
      if (isBetter(t, best[root[t]])) best[root[t]] = t;
    }
    for (const auto t : tied) {
      if (best[root[t]] == t) centers[root[t]].at = centers[t].at;
    }
  }

  /// Counts the edges of each cell, and sets `offsets`: one edge for each side of a triangle at the cell's
  /// site, unless the centers of the triangles on both sides of it are tied.
  Result<void> count(std::size_t sites) {
    auto& offsets = cells_.offsets;
    const auto& root = cells_.root_;
    offsets.assign(sites + 1, 0);
    std::vector<std::uint32_t> edges(mesh_.site.size());
    each(mesh_.triangles.size(), [&](std::uint32_t t) {
      const auto& [corner, neighbor] = mesh_.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        if (root[t] == root[static_cast<std::size_t>(neighbor[k])]) continue;
        const std::atomic_ref at(edges[static_cast<std::size_t>(corner[(k + 1) % 3])]);
        at.fetch_add(1, std::memory_order_relaxed);
      }
    });
    each(mesh_.site.size(), [&](std::uint32_t v) {
      if (mesh_.at[v] >= 0) offsets[mesh_.site[v] + std::size_t{1}] = edges[v];
    });
    for (std::size_t v = 0; v < mesh_.site.size(); ++v) {
      if (mesh_.at[v] < 0 || edges[v] >= 2) continue;
      return tl::unexpected(refusalOf(
          Subject::sites,
          fmt::format("site {} is so near to others that rounding leaves it no edge", mesh_.site[v])));
    }
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    return {};
  }

  void findPlaces() {
    cells_.places_.resize(cells_.centers_.size());
    each(cells_.places_.size(), [&](std::uint32_t t) {
      if (cells_.root_[t] == t) cells_.places_[t] = placeOf(cells_.centers_[t].at);
    });
  }

  [[nodiscard]] const Direction& vectorAt(std::int32_t v) const {
    return vectors_[static_cast<std::size_t>(v)];
  }

  const SphereMesh& mesh_;
  int threads_;
  SphereSites sites_;
  std::span<const Direction> vectors_;
  SphereCells cells_;
  DisjointSets joined_;
};

Result<SphereCells> cellsOfSphere(const SphereSites& sites, const SphereMesh& mesh, bool has_places,
                                  int threads) {
  if (!mesh.circle.empty()) return CellRows::ofCircle(sites, mesh, has_places);
  return CellRows(sites, mesh, threads).run(sites.direction.size(), has_places);
}

void SphereCells::visit(std::size_t begin, std::size_t end,
                        const std::function<void(const SphereCell&)>& work) const {
  if (mesh_->circle.empty()) return visitMesh(begin, end, work);
  Slices(*sites_, mesh_->circle, axis_).visit(begin, end, !places_.empty(), work);
}

void SphereCells::visitMesh(std::size_t begin, std::size_t end,
                            const std::function<void(const SphereCell&)>& work) const {
  std::vector<MeshCorner> around;
  std::vector<std::int64_t> neighbor;
  std::vector<Direction> vertex;
  std::vector<Point> place;
  for (auto v = begin; v < end; ++v) {
    listAround(*mesh_, root_, static_cast<std::uint32_t>(v), around);
    if (around.empty()) continue;
    neighbor.resize(around.size());
    vertex.resize(around.size());
    if (!places_.empty()) place.resize(around.size());
    std::uint64_t lowest = ~std::uint64_t{0};  // site and position
    for (std::size_t k = 0; k < around.size(); ++k) {
      lowest = std::min(lowest, std::uint64_t{mesh_->site[around[k].first]} << 32 | k);
    }
    std::ranges::rotate(around, around.begin() + static_cast<std::ptrdiff_t>(lowest & ~std::uint32_t{0}));
    for (std::size_t k = 0; k < around.size(); ++k) {
      neighbor[k] = mesh_->site[around[k].first];
      vertex[k] = centers_[around[k].triangle].at;
      if (!places_.empty()) place[k] = places_[around[k].triangle];
    }
    work({mesh_->site[v], along_[v], neighbor, vertex, place});
  }
}

GreatArc arcOf(std::span<const Direction> sites, const SphereCell& cell, std::size_t edge) {
  const auto next = edge + 1 < cell.vertex.size() ? edge + 1 : 0;
  return arcBetween(sites[cell.site], sites[static_cast<std::size_t>(cell.neighbor[edge])], cell.vertex[edge],
                    cell.vertex[next], next == edge);
}

GreatArc arcBetween(const Direction& site, const Direction& neighbor, const Direction& begin,
                    const Direction& end, bool is_sole) {
  constexpr double nearly_half = 3;
  const Direction between = normalized(site - neighbor);
  if (is_sole) return {begin, end, between, 2 * std::numbers::pi};
  const double angle = angleBetween(begin, end);
  return {begin, end, angle > 0 && angle < nearly_half ? normalized(cross(begin, end)) : between, angle};
}

Direction pointOn(const GreatArc& arc, double fraction) {
  const double angle = fraction * arc.angle;
  return std::cos(angle) * arc.begin + std::sin(angle) * cross(arc.axis, arc.begin);
}

}  // namespace vorpipe::core
