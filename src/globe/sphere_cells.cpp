#include "globe/sphere_cells.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "backend/tie.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t cells_grain = 4096;

/// The direction in which three sites share a vertex.
struct Center {
  Direction at;
  double rounding;  ///< how far rounding may move it, in radians
};

/// At right angles to the plane through the three vectors. Near a site it is that site's direction p plus the
/// part of a vector at right angles to that plane: (p + u) . (v - w) = 0 for its vector v and both others, w.
/// That keeps the digits of sites that are near to each other.
Center centerOf(const SphereSites& sites, const std::array<std::int32_t, 3>& corner) {
  constexpr double few = 8, near = 0.5, epsilon = std::numeric_limits<double>::epsilon();
  const auto vectors = sites.vectors();
  const std::array t{static_cast<std::size_t>(corner[0]), static_cast<std::size_t>(corner[1]),
                     static_cast<std::size_t>(corner[2])};
  const Direction a = vectors[t[1]] - vectors[t[0]], b = vectors[t[2]] - vectors[t[0]];
  const Direction across = cross(a, b);
  const double size = lengthOf(across), longest = std::max(lengthOf(a), lengthOf(b));
  const auto depth = [&](std::size_t site) { return depthOf(sites, t[0], site); };
  const Direction way = 1 / (size * size) * (depth(t[1]) * cross(b, across) + depth(t[2]) * cross(across, a));
  if (lengthOf(way) < near && dot(sites.direction[t[0]], across) > 0) {
    return {normalized(sites.direction[t[0]] + way), few * epsilon * (1 + longest * longest / size)};
  }
  return {1 / size * across, few * epsilon * longest / size};
}

/// The cells of a mesh's sites. Vertices of the mesh lie along a curve, so what is by vertex here is too.
class Rows {
 public:
  Rows(const SphereSites& sites, const SphereMesh& mesh, int threads)
      : mesh_(mesh),
        threads_(threads),
        sites_(along(sites)),
        vectors_(sites_.vectors()),
        joined_(mesh.triangles.size()) {}

  Result<SphereCells> run(std::size_t sites, bool has_places) {
    VORPIPE_TRY(findCenters());
    each(mesh_.triangles.size(), [this](std::uint32_t t) { joinTies(t); });
    settleCenters();
    SphereCells cells;
    VORPIPE_TRY(count(sites, cells));
    write(cells, has_places);
    return cells;
  }

 private:
  /// A triangle around a vertex, and the vertex after it there, counter-clockwise. The edge to that vertex
  /// begins in the triangle before.
  struct Corner {
    std::uint32_t triangle, first;
  };

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
    centers_.resize(mesh_.triangles.size());
    each(centers_.size(),
         [this](std::uint32_t t) { centers_[t] = centerOf(sites_, mesh_.triangles[t].corner); });
    const auto lost = std::ranges::find_if(
        centers_, [](const Center& center) { return !std::isfinite(lengthOf(center.at)); });
    if (lost == centers_.end()) return {};
    const auto& corner = mesh_.triangles[static_cast<std::size_t>(lost - centers_.begin())].corner;
    return tl::unexpected(refusalOf(
        Subject::sites, fmt::format("site {} is so near to others that rounding leaves no vertex to them",
                                    mesh_.site[static_cast<std::size_t>(corner[0])])));
  }

  /// Joins a triangle with those across its edges that are ties, and of higher numbers.
  void joinTies(std::uint32_t t) {
    const MeshTriangle& triangle = mesh_.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto next = static_cast<std::uint32_t>(triangle.neighbor[k]);
      if (next < t) continue;
      const Center &a = centers_[t], &b = centers_[next];
      const Direction sides = vectorAt(triangle.corner[(k + 1) % 3]) - vectorAt(triangle.corner[(k + 2) % 3]);
      const double tie = std::max(shortest_edge * lengthOf(sides), a.rounding + b.rounding);
      const Direction way = b.at - a.at;
      if (dot(way, way) <= tie * tie) joined_.join(t, next);
    }
  }

  /// Centers that ties join are where the one is that rounding moves least.
  void settleCenters() {
    const auto count = static_cast<std::uint32_t>(centers_.size());
    root_.resize(count);
    each(count, [this](std::uint32_t t) { root_[t] = joined_.root(t); });
    std::vector<std::uint32_t> best(count);
    each(count, [&](std::uint32_t t) { best[t] = t; });
    for (std::uint32_t t = 0; t < count; ++t) {
      auto& of_root = best[root_[t]];
      if (centers_[t].rounding < centers_[of_root].rounding) of_root = t;
    }
    vertex_.resize(count);
    each(count, [&](std::uint32_t t) { vertex_[t] = centers_[best[t]].at; });
    centers_ = {};
  }

  /// Lists the triangles around a vertex whose edges are no ties, counter-clockwise.
  void listAround(std::uint32_t v, std::vector<Corner>& around) const {
    around.clear();
    const auto begin = mesh_.at[v];
    if (begin < 0) return;
    auto t = begin;
    std::uint32_t before = none;
    do {
      const MeshTriangle& triangle = mesh_.triangles[static_cast<std::size_t>(t)];
      std::size_t k = 0;
      while (triangle.corner[k] != static_cast<std::int32_t>(v)) ++k;
      const auto root = root_[static_cast<std::size_t>(t)];
      around.push_back({root, static_cast<std::uint32_t>(triangle.corner[(k + 1) % 3])});
      before = root;
      t = triangle.neighbor[(k + 1) % 3];
    } while (t != begin);
    // From here, `triangle` is the one where the edge begins.
    std::size_t kept = 0;
    for (const Corner corner : around) {
      if (corner.triangle != before) around[kept++] = {before, corner.first};
      before = corner.triangle;
    }
    around.resize(kept);
  }

  /// Counts the edges of each cell, and sets `cells.offsets`: one edge for each side of a triangle at the
  /// cell's site, unless the centers of the triangles on both sides of it are tied.
  Result<void> count(std::size_t sites, SphereCells& cells) {
    cells.offsets.assign(sites + 1, 0);
    std::vector<std::uint32_t> edges(mesh_.site.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& [corner, neighbor] = mesh_.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        if (root_[t] != root_[static_cast<std::size_t>(neighbor[k])])
          ++edges[static_cast<std::size_t>(corner[(k + 1) % 3])];
      }
    }
    for (std::size_t v = 0; v < mesh_.site.size(); ++v) {
      if (mesh_.at[v] >= 0) cells.offsets[mesh_.site[v] + std::size_t{1}] = edges[v];
    }
    for (std::size_t v = 0; v < mesh_.site.size(); ++v) {
      const auto site = mesh_.site[v];
      if (mesh_.at[v] >= 0 && cells.offsets[site + std::size_t{1}] < 2) {
        return tl::unexpected(
            refusalOf(Subject::sites,
                      fmt::format("site {} is so near to others that rounding leaves it no edge", site)));
      }
    }
    for (std::size_t i = 0; i < sites; ++i) cells.offsets[i + 1] += cells.offsets[i];
    return {};
  }

  /// Writes each row from its lowest neighbor.
  void write(SphereCells& cells, bool has_places) {
    std::vector<Point> places(has_places ? vertex_.size() : 0);
    each(places.size(), [&](std::uint32_t t) {
      if (root_[t] == t) places[t] = placeOf(vertex_[t]);
    });
    cells.neighbor.resize(cells.offsets.back());
    cells.vertex.resize(cells.offsets.back());
    if (has_places) cells.place.resize(cells.offsets.back());
    parallelFor(mesh_.site.size(), cells_grain, threads_, [&](std::size_t begin, std::size_t end) {
      std::vector<Corner> around;
      for (auto v = begin; v < end; ++v) {
        listAround(static_cast<std::uint32_t>(v), around);
        const auto siteOf = [&](const Corner& corner) { return mesh_.site[corner.first]; };
        std::ranges::rotate(around, std::ranges::min_element(around, {}, siteOf));
        auto out = cells.offsets[mesh_.site[v]];
        for (const Corner& corner : around) {
          cells.neighbor[out] = siteOf(corner);
          cells.vertex[out] = vertex_[corner.triangle];
          if (has_places) cells.place[out] = places[corner.triangle];
          ++out;
        }
      }
    });
  }

  [[nodiscard]] const Direction& vectorAt(std::int32_t v) const {
    return vectors_[static_cast<std::size_t>(v)];
  }

  static constexpr std::uint32_t none = ~std::uint32_t{0};

  const SphereMesh& mesh_;
  int threads_;
  SphereSites sites_;
  std::span<const Direction> vectors_;
  DisjointSets joined_;
  std::vector<Center> centers_;      ///< by triangle
  std::vector<std::uint32_t> root_;  ///< by triangle: the lowest with the same center
  std::vector<Direction> vertex_;    ///< by triangle, of roots alone
};

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
SphereCells slices(std::span<const Direction> sites, const std::vector<std::uint32_t>& circle) {
  SphereCells cells;
  const auto count = circle.size();
  std::vector<std::uint32_t> at(sites.size(), no_site);
  for (std::uint32_t k = 0; k < count; ++k) at[circle[k]] = k;
  const Direction axis = count == 2 ? perpendicular(normalized(sites[std::min(circle[0], circle[1])] -
                                                               sites[std::max(circle[0], circle[1])]))
                                    : axisOf(sites, circle);
  cells.offsets.push_back(0);
  for (std::size_t site = 0; site < sites.size(); ++site) {
    const auto k = at[site];
    if (k != no_site && count == 2) {
      cells.neighbor.push_back(circle[1 - k]);
      cells.vertex.push_back(axis);
    } else if (k != no_site && count > 2) {
      std::array<std::uint32_t, 2> around{circle[k > 0 ? k - 1 : count - 1],
                                          circle[k + 1 < count ? k + 1 : 0]};
      std::ranges::sort(around);
      for (const auto other : around) {
        // Around the site, the edge runs counter-clockwise about the way from its neighbor.
        const auto next = around[other == around[0] ? 1 : 0];
        const Direction turn = cross(sites[site] - sites[other], sites[site] - sites[next]);
        cells.neighbor.push_back(other);
        cells.vertex.push_back(dot(turn, axis) > 0 ? -axis : axis);
      }
    }
    cells.offsets.push_back(cells.neighbor.size());
  }
  return cells;
}

}  // namespace

Result<SphereCells> cellsOfSphere(const SphereSites& sites, const SphereMesh& mesh, bool has_places,
                                  int threads) {
  if (mesh.circle.empty()) return Rows(sites, mesh, threads).run(sites.direction.size(), has_places);
  SphereCells cells = slices(sites.vectors(), mesh.circle);
  for (const Direction& vertex : cells.vertex) {
    if (has_places) cells.place.push_back(placeOf(vertex));
  }
  return cells;
}

GreatArc arcOf(std::span<const Direction> sites, const SphereCells& cells, std::size_t site,
               std::uint64_t edge) {
  const auto next = edge + 1 < cells.offsets[site + 1] ? edge + 1 : cells.offsets[site];
  return arcBetween(sites[site], sites[static_cast<std::size_t>(cells.neighbor[edge])], cells.vertex[edge],
                    cells.vertex[next], next == edge);
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
