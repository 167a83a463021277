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

/// The triangles around vertices of a mesh.
class Around {
 public:
  /// The triangle, by `root`, where an edge of a cell begins, and the site across.
  struct CellEdge {
    std::uint32_t triangle, site;
  };

  Around(const SphereMesh& mesh, const std::vector<std::uint32_t>& root) : mesh_(mesh), root_(root) {}

  /// Has the processor fetch triangles of vertices that follow: else each waits for memory. (Not inlined, GCC
  /// would drop the call.)
  [[gnu::always_inline]] inline void fetchAhead(std::size_t v) const {
    constexpr std::size_t ahead = 8;
    const auto first = std::min(v + 2 * ahead, mesh_.at.size() - 1), then = std::min(v + ahead, first);
    if (mesh_.at[first] >= 0) __builtin_prefetch(&mesh_.triangles[static_cast<std::size_t>(mesh_.at[first])]);
    if (mesh_.at[then] < 0) return;
    for (const auto beside : mesh_.triangles[static_cast<std::size_t>(mesh_.at[then])].neighbor)
      __builtin_prefetch(&mesh_.triangles[static_cast<std::size_t>(beside)]);
  }

  /// Appends the edges of the cell of a vertex, counter-clockwise, that to the lowest site first; nothing if
  /// it has no cell.
  void list(std::size_t v, std::vector<CellEdge>& edges) {
    if (mesh_.at[v] < 0) return;
    auto k = walk(v);
    const auto count = corner_.size();
    // The edge to a neighbor begins in the triangle before.
    auto before = k > 0 ? k - 1 : count - 1;
    for (std::size_t e = 0; e < count; ++e) {
      edges.push_back({corner_[before].triangle, corner_[k].site});
      before = k;
      if (++k == count) k = 0;
    }
  }

 private:
  /// A triangle, and the site of the vertex after it, counter-clockwise.
  struct Corner {
    std::uint32_t triangle, site;
  };
  static constexpr std::uint32_t no_triangle = ~std::uint32_t{0};

  /// The lowest of some sites, and its place.
  class Lowest {
   public:
    void take(std::uint32_t site, std::size_t place) {
      site_and_place_ = std::min(site_and_place_, std::uint64_t{site} << 32 | place);
    }
    [[nodiscard]] std::size_t place() const { return site_and_place_ & ~std::uint32_t{0}; }

   private:
    std::uint64_t site_and_place_ = ~std::uint64_t{0};
  };

  /// Lists the triangles, by root, around a vertex, without those after edges that are ties. Returns the
  /// place of the lowest site.
  std::size_t walk(std::size_t v) {
    const auto own = static_cast<std::int32_t>(v), begin = mesh_.at[v];
    auto t = begin;
    auto before = no_triangle;
    bool has_ties = false;
    corner_.clear();
    Lowest lowest;
    do {
      const MeshTriangle& triangle = mesh_.triangles[static_cast<std::size_t>(t)];
      const auto& corner = triangle.corner;
      // The corner after its own, without a jump that no processor would foresee.
      const auto next = std::size_t{corner[0] == own} + 2 * std::size_t{corner[1] == own};
      const auto root = root_[static_cast<std::size_t>(t)];
      const auto site = mesh_.site[static_cast<std::size_t>(corner[next])];
      has_ties |= root == before;
      before = root;
      lowest.take(site, corner_.size());
      corner_.push_back({root, site});
      t = triangle.neighbor[next];
    } while (t != begin);
    if (has_ties || corner_.front().triangle == before) lowest = dropTies();
    return lowest.place();
  }

  Lowest dropTies() {
    auto before = corner_.back().triangle;
    std::size_t kept = 0;
    Lowest least;
    for (const Corner corner : corner_) {
      if (corner.triangle == std::exchange(before, corner.triangle)) continue;
      least.take(corner.site, kept);
      corner_[kept++] = corner;
    }
    corner_.resize(kept);
    return least;
  }

  const SphereMesh& mesh_;
  const std::vector<std::uint32_t>& root_;
  std::vector<Corner> corner_;
};

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
    joinTies();
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

  Result<void> findCenters() {
    auto& centers = cells_.centers_;
    centers.resize(mesh_.triangles.size());
    std::atomic<std::uint32_t> lost = no_site;
    parallelFor(centers.size(), cells_grain, threads_, [&](std::size_t begin, std::size_t end) {
      SphereCenterBatch batch;
      for (auto first = begin; first < end; first += batch.room) {
        const auto count = std::min(end - first, batch.room);
        for (std::size_t k = 0; k < count; ++k) {
          fetchCorners(first + k);
          const auto corner = fromLowest(mesh_.triangles[first + k].corner);
          batch.set(k, sites_,
                    {static_cast<std::size_t>(corner[0]), static_cast<std::size_t>(corner[1]),
                     static_cast<std::size_t>(corner[2])});
        }
        batch.find();
        for (std::size_t k = 0; k < count; ++k) {
          const auto t = first + k;
          centers[t] = batch.center(k);
          if (std::isfinite(dot(centers[t].at, centers[t].at))) continue;
          lowerTo(lost, mesh_.site[static_cast<std::size_t>(fromLowest(mesh_.triangles[t].corner)[0])]);
        }
      }
    });
    if (lost == no_site) return {};
    return tl::unexpected(refusalOf(
        Subject::sites,
        fmt::format("site {} is so near to others that rounding leaves no vertex to them", lost.load())));
  }

  /// Has the processor fetch the sites of a triangle that follows. (Not inlined, GCC would drop the call.)
  [[gnu::always_inline]] inline void fetchCorners(std::size_t t) const {
    constexpr std::size_t ahead = 16;
    for (const auto v : mesh_.triangles[std::min(t + ahead, mesh_.triangles.size() - 1)].corner)
      __builtin_prefetch(&vectors_[static_cast<std::size_t>(v)]);
  }
  /// The same for centers on the other sides of its edges.
  [[gnu::always_inline]] inline void fetchCenters(std::size_t t) const {
    constexpr std::size_t ahead = 16;
    for (const auto other : mesh_.triangles[std::min(t + ahead, mesh_.triangles.size() - 1)].neighbor)
      __builtin_prefetch(&cells_.centers_[static_cast<std::size_t>(other)]);
  }

  static void lowerTo(std::atomic<std::uint32_t>& lowest, std::uint32_t site) {
    auto known = lowest.load();
    while (site < known && !lowest.compare_exchange_weak(known, site)) {
    }
  }

  /// Joins triangles with those across their edges that are ties.
  void joinTies() {
    const double far = 2.001 * longestVector();
    parallelFor(mesh_.triangles.size(), cells_grain, threads_, [&](std::size_t begin, std::size_t end) {
      for (auto t = begin; t < end; ++t) {
        fetchCenters(t);
        for (std::size_t k = 0; k < 3; ++k) {
          const auto next = static_cast<std::size_t>(mesh_.triangles[t].neighbor[k]);
          // A bound, of few numbers, that nearly all edges exceed.
          if (isTie(t, next, far) && next > t && isTie(t, next, lengthOf(sideOf(t, k))))
            joined_.join(static_cast<std::uint32_t>(t), static_cast<std::uint32_t>(next));
        }
      }
    });
  }

  /// Whether the vertices of two triangles are one, where the sites of the edge between them are so far from
  /// each other.
  [[nodiscard]] bool isTie(std::size_t t, std::size_t next, double distance) const {
    const SphereCenter &a = cells_.centers_[t], &b = cells_.centers_[next];
    const double tie = std::max(shortest_edge * distance, a.rounding + b.rounding);
    const Direction way = b.at - a.at;
    return dot(way, way) <= tie * tie;
  }

  [[nodiscard]] Direction sideOf(std::size_t t, std::size_t k) const {
    const auto& corner = mesh_.triangles[t].corner;
    return vectorAt(corner[(k + 1) % 3]) - vectorAt(corner[(k + 2) % 3]);
  }

  [[nodiscard]] double longestVector() const {
    const auto& excess = sites_.excess;
    return 1 + (excess.empty() ? 0 : std::max(0.0, *std::ranges::max_element(excess)));
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
  constexpr std::size_t few = 32;
  Around around(*mesh_, root_);
  std::vector<Around::CellEdge> edges;
  std::array<std::size_t, few + 1> row{};
  std::vector<std::int64_t> neighbor;
  std::vector<Direction> vertex;
  std::vector<Point> place;
  for (; begin < end; begin += few) {
    const auto count = std::min(few, end - begin);
    edges.clear();
    for (std::size_t k = 0; k < count; ++k) {
      around.fetchAhead(begin + k);
      around.list(begin + k, edges);
      row[k + 1] = edges.size();
      for (auto e = row[k]; e < row[k + 1]; ++e) {
        __builtin_prefetch(&centers_[edges[e].triangle]);
        if (!places_.empty()) __builtin_prefetch(&places_[edges[e].triangle]);
      }
    }
    neighbor.resize(edges.size());
    vertex.resize(edges.size());
    if (!places_.empty()) place.resize(edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto [triangle, site] = edges[e];
      neighbor[e] = site;
      vertex[e] = centers_[triangle].at;
      if (!places_.empty()) place[e] = places_[triangle];
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (mesh_->at[begin + k] < 0) continue;
      const auto rowOf = [&](const auto& of_all) {
        return std::span(of_all).subspan(row[k], row[k + 1] - row[k]);
      };
      work({mesh_->site[begin + k], along_[begin + k], rowOf(neighbor), rowOf(vertex),
            places_.empty() ? std::span<const Point>() : rowOf(place)});
    }
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
