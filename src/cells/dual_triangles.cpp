#include "cells/dual_triangles.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include "base/parallel.h"
#include "geometry/polygon_measures.h"
#include "geometry/predicates.h"
#include "geometry/triangulation.h"

namespace vorpipe::core {
namespace {

bool isOutside(const MeshTriangle& t) {
  return std::find(t.corner.begin(), t.corner.end(), ghost) != t.corner.end();
}

/// A triangle whose corner k is the site siteOf(k), by input index, the lowest first.
template <class SiteOf>
Triangles::value_type named(const SiteSet& sites, const MeshTriangle& t, const SiteOf& siteOf) {
  Triangles::value_type ids{};
  std::transform(t.corner.begin(), t.corner.end(), ids.begin(),
                 [&](auto k) { return sites.id[siteOf(static_cast<std::size_t>(k))]; });
  std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
  return ids;
}

using Edge = std::pair<std::int32_t, std::int32_t>;

/// Whether some vertex of a cell is not inside the domain. This holds for all three sites of a triangle whose
/// center is not inside the domain: without clipping, their cells would reach that center.
bool reachesOutside(const ProposedCells& agreed, const TiedCells& tied, std::size_t cell) {
  const auto row = agreed.cells.edges(cell);
  if (row.empty() || std::any_of(row.begin(), row.end(), [](auto n) { return n < 0; })) return true;
  if (!tied.has(cell)) return false;
  return std::ranges::any_of(tied.vertices(tied.entry[cell]),
                             [&](auto vertex) { return tied.walls[vertex] != 0; });
}

/// The Delaunay mesh of a subset of the sites.
class OuterMesh {
 public:
  OuterMesh(const SiteSet& sites, std::vector<std::uint32_t> cells)
      : sites_(sites), cells_(std::move(cells)) {
    std::vector<Point> points;
    points.reserve(cells_.size());
    std::vector<double> weights;
    for (const auto cell : cells_) {
      points.push_back({sites.x[cell], sites.y[cell]});
      if (!sites.weight.empty()) weights.push_back(sites.weight[cell]);
    }
    mesh_ = delaunay(points, weights).triangles;
  }

  [[nodiscard]] std::size_t hullEdges() const {
    return static_cast<std::size_t>(
        std::count_if(mesh_.begin(), mesh_.end(), [](const auto& t) { return isOutside(t); }));
  }

  /// Appends the triangles between the hull and the known ones. The known triangles lie to the left of the
  /// `known` edges, which are sorted pairs of indices in cells_.
  void appendBeyond(const std::vector<Edge>& known, Triangles& triangles) const {
    std::vector<std::uint8_t> reached(mesh_.size());
    std::vector<std::size_t> open;
    const auto reach = [&](std::size_t t) {
      if (std::exchange(reached[t], std::uint8_t{1}) == 0) open.push_back(t);
    };
    for (std::size_t t = 0; t < mesh_.size(); ++t) {
      if (isOutside(mesh_[t])) reach(t);
    }
    while (!open.empty()) {
      const auto& here = mesh_[open.back()];
      open.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge seen_from_there{here.corner[(k + 2) % 3], here.corner[(k + 1) % 3]};
        if (!std::binary_search(known.begin(), known.end(), seen_from_there)) {
          reach(static_cast<std::size_t>(here.neighbor[k]));
        }
      }
    }
    for (std::size_t t = 0; t < mesh_.size(); ++t) {
      if (reached[t] != 0 && !isOutside(mesh_[t])) {
        triangles.push_back(named(sites_, mesh_[t], [&](std::size_t k) { return cells_[k]; }));
      }
    }
  }

  /// The number of each site in this mesh by input index, or `ghost`.
  [[nodiscard]] std::vector<std::int32_t> numbers() const {
    std::vector<std::int32_t> number;
    const auto most = std::max_element(sites_.id.begin(), sites_.id.end());
    number.assign(*most + std::size_t{1}, ghost);
    for (std::size_t k = 0; k < cells_.size(); ++k)
      number[sites_.id[cells_[k]]] = static_cast<std::int32_t>(k);
    return number;
  }

 private:
  const SiteSet& sites_;
  std::vector<std::uint32_t> cells_;
  BigVector<MeshTriangle> mesh_;
};

/// The edges, sorted, of triangles between sites of the mesh.
std::vector<Edge> knownEdges(const OuterMesh& mesh, const Triangles& triangles) {
  const auto number = mesh.numbers();
  std::vector<Edge> known;
  for (const auto& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge{number[triangle[k]], number[triangle[(k + 1) % 3]]};
      if (edge.first != ghost && edge.second != ghost) known.push_back(edge);
    }
  }
  std::sort(known.begin(), known.end());
  return known;
}

/// The number of sites that should be corners of triangles: all of them. With weights, those that are
/// corners, or 0 if a site with a cell is missing.
std::size_t cornersOf(const ProposedCells& agreed, const Triangles& triangles) {
  const auto& sites = agreed.sites;
  if (sites.weight.empty()) return sites.size();
  const auto most = *std::max_element(sites.id.begin(), sites.id.end());
  std::vector<std::uint8_t> is_corner(most + std::size_t{1});
  for (const auto& triangle : triangles) {
    for (const auto id : triangle) is_corner[id] = 1;
  }
  for (std::size_t cell = 0; cell < sites.size(); ++cell) {
    if (agreed.cells.status(cell) == CellStatus::certified && is_corner[sites.id[cell]] == 0) return 0;
  }
  return static_cast<std::size_t>(std::count(is_corner.begin(), is_corner.end(), 1));
}

constexpr std::size_t dual_triangles_grain = 4096;

using Triple = std::array<std::int32_t, 3>;

Triple sorted(std::int32_t a, std::int32_t b, std::int32_t c) {
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return {a, b, c};
}

/// Whether direction a comes before b, counter-clockwise from the positive x axis.
bool turnsLess(Point a, Point b) {
  const bool a_below = a.y < 0 || (a.y == 0 && a.x < 0);
  const bool b_below = b.y < 0 || (b.y == 0 && b.x < 0);
  return a_below != b_below ? b_below : a.x * b.y - a.y * b.x > 0;
}

/// By vertex of tied cells: 1 if exactly one triple meets there.
std::vector<std::uint8_t> plainVertices(const ProposedCells& agreed, const TiedCells& tied) {
  std::vector<std::uint8_t> plain(tied.position.size(), 1);
  std::vector<Triple> seen(tied.position.size());
  for (std::size_t k = 0; k < tied.cell.size(); ++k) {
    const auto row = agreed.cells.edges(tied.cell[k]);
    for (std::size_t e = 0; e < row.size(); ++e) {
      const auto vertex = tied.vertex[tied.offsets[k] + e];
      const auto here = sorted(static_cast<std::int32_t>(tied.cell[k]), row[edgeBefore(row, e)], row[e]);
      if (seen[vertex] == Triple{}) seen[vertex] = here;
      if (seen[vertex] != here) plain[vertex] = 0;
    }
  }
  return plain;
}

/// Orders sites counter-clockwise along their convex hull (Andrew's monotone chain). Returns false if a site
/// is not a corner of it.
bool sortAroundPolygon(const SiteSet& sites, std::vector<std::uint32_t>& around) {
  if (around.size() < 3) return true;
  const auto at = [&](std::uint32_t site) { return Point{sites.x[site], sites.y[site]}; };
  std::sort(around.begin(), around.end(), [&](auto a, auto b) {
    return std::pair(sites.x[a], sites.y[a]) < std::pair(sites.x[b], sites.y[b]);
  });
  std::vector<std::uint32_t> polygon;
  const auto addChain = [&](auto begin, auto end) {
    const auto first = polygon.size();
    for (auto site = begin; site != end; ++site) {
      while (polygon.size() >= first + 2 &&
             orientation(at(polygon[polygon.size() - 2]), at(polygon.back()), at(*site)) <= 0) {
        polygon.pop_back();
      }
      polygon.push_back(*site);
    }
    polygon.pop_back();
  };
  addChain(around.begin(), around.end());
  addChain(around.rbegin(), around.rend());
  if (polygon.size() != around.size()) return false;
  around = std::move(polygon);
  return true;
}

/// The cells around a vertex, counter-clockwise from that of the lowest input index. Returns false if that is
/// not known: with weights, some of the sites may lie inside the polygon of the others.
bool cellsAround(const ProposedCells& agreed, const TiedCells& tied, std::size_t vertex,
                 std::vector<std::uint32_t>& around) {
  const auto& sites = agreed.sites;
  const auto cells = tied.cellsAt(vertex);
  around.assign(cells.begin(), cells.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  const auto way = [&](std::uint32_t cell) {
    return relativeTo({sites.x[cell], sites.y[cell]}, tied.position[vertex]);
  };
  if (sites.weight.empty()) {
    std::sort(around.begin(), around.end(), [&](auto a, auto b) { return turnsLess(way(a), way(b)); });
  } else if (!sortAroundPolygon(sites, around)) {
    return false;
  }
  const auto lowest = std::ranges::min_element(around, {}, [&](auto site) { return sites.id[site]; });
  std::rotate(around.begin(), lowest, around.end());
  return true;
}

/// Whether the center of the circle through three sites is at a vertex that ties make, within a few ties of
/// the nearest two sites. That vertex may have much longer ties.
bool isAbout(const SiteSet& sites, const std::array<std::uint32_t, 3>& cells, const AnchoredPoint& vertex) {
  constexpr double ties = 4;
  const auto way = [&](std::uint32_t a, std::uint32_t b) {
    return lengthOf({sites.x[b] - sites.x[a], sites.y[b] - sites.y[a]});
  };
  const auto [a, b, c] = cells;
  const AnchoredPoint center = cornerPosition(sites, static_cast<std::int32_t>(a),
                                              static_cast<std::int32_t>(b), static_cast<std::int32_t>(c));
  return lengthOf(wayBetween(vertex, center)) <=
         ties * shortest_edge * std::min({way(a, b), way(b, c), way(c, a)});
}

/// The Delaunay triangulation of the sites around a tie, as indices in `around`. The sites are the corners of
/// a convex polygon, usually four.
std::vector<std::array<std::size_t, 3>> triangulated(const SiteSet& sites,
                                                     const std::vector<std::uint32_t>& around) {
  const auto at = [&](std::size_t k) {
    const auto site = around[k];
    return WeightedPoint{{sites.x[site], sites.y[site]}, sites.weight.empty() ? 0 : sites.weight[site]};
  };
  if (around.size() == 4) {
    const bool meets_last =
        orientation(at(0), at(1), at(2)) > 0 && inCirclePerturbed(at(0), at(1), at(2), at(3)) > 0;
    if (meets_last) return {{0, 1, 3}, {1, 2, 3}};
    return {{0, 1, 2}, {0, 2, 3}};
  }
  std::vector<Point> points;
  std::vector<double> weights;
  for (std::size_t k = 0; k < around.size(); ++k) {
    points.push_back(at(k));
    if (!sites.weight.empty()) weights.push_back(at(k).weight);
  }
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const auto& t : delaunay(points, weights).triangles) {
    if (isOutside(t)) continue;
    triangles.push_back({static_cast<std::size_t>(t.corner[0]), static_cast<std::size_t>(t.corner[1]),
                         static_cast<std::size_t>(t.corner[2])});
  }
  return triangles;
}

/// Calls put(triangle) for the triangles that fill the polygon of the sites around a tie, as in the
/// triangulation of all sites. Returns false if that is unknown: three of the sites lie on one line, or those
/// of a triangle are as near to each other as ties of others are long.
template <class Put>
bool forTriangulated(const SiteSet& sites, const std::vector<std::uint32_t>& around,
                     const AnchoredPoint& vertex, const Put& put) {
  if (around.size() < 3) return true;
  const auto triangles = triangulated(sites, around);
  if (triangles.size() + 2 != around.size()) return false;
  const auto at = [&](std::uint32_t site) { return Point{sites.x[site], sites.y[site]}; };
  for (const auto& [i, j, k] : triangles) {
    const std::array<std::uint32_t, 3> cells{around[i], around[j], around[k]};
    if (!(orientation(at(cells[0]), at(cells[1]), at(cells[2])) > 0) || !isAbout(sites, cells, vertex))
      return false;
    Triangles::value_type ids{sites.id[cells[0]], sites.id[cells[1]], sites.id[cells[2]]};
    std::rotate(ids.begin(), std::ranges::min_element(ids), ids.end());
    put(ids);
  }
  return true;
}

/// Calls put(triangle) for each triangle of plain vertices whose lowest input index is that of `cell`.
template <class Put>
void forTriangles(const ProposedCells& agreed, const TiedCells& tied, const std::vector<std::uint8_t>& plain,
                  std::size_t cell, const Put& put) {
  const auto& id = agreed.sites.id;
  const auto row = agreed.cells.edges(cell);
  const bool is_tied = tied.has(cell);
  const auto own = id[cell];
  for (std::size_t e = 0; e < row.size(); ++e) {
    const auto before = row[edgeBefore(row, e)];
    const auto after = row[e];
    if (before < 0 || after < 0) continue;
    const auto p = id[static_cast<std::size_t>(before)];
    const auto q = id[static_cast<std::size_t>(after)];
    if (own > p || own > q) continue;
    if (is_tied && plain[tied.vertex[tied.offsets[tied.entry[cell]] + e]] == 0) continue;
    put({own, p, q});
  }
}

/// Appends the triangles of each i below `count`: make(i, put) calls put(triangle) for each of them.
template <class Make>
void append(std::size_t count, int threads, Triangles& triangles, const Make& make) {
  std::vector<std::size_t> first((count + dual_triangles_grain - 1) / dual_triangles_grain + 1);
  parallelFor(count, dual_triangles_grain, threads, [&](std::size_t begin, std::size_t end) {
    std::size_t made = 0;
    for (auto i = begin; i < end; ++i) make(i, [&](const Triangles::value_type&) { ++made; });
    first[begin / dual_triangles_grain + 1] = made;
  });
  first[0] = triangles.size();
  for (std::size_t b = 1; b < first.size(); ++b) first[b] += first[b - 1];
  triangles.resize(first.back());
  parallelFor(count, dual_triangles_grain, threads, [&](std::size_t begin, std::size_t end) {
    auto to = first[begin / dual_triangles_grain];
    for (auto i = begin; i < end; ++i) {
      make(i, [&](const Triangles::value_type& triangle) { triangles[to++] = triangle; });
    }
  });
}

/// The Delaunay triangulation of all sites without the help of cells, on one thread.
Triangles allTriangles(SiteMesh& mesh) {
  const auto& sites = mesh.sites();
  Triangles triangles;
  if (const auto* made = mesh.get(); made != nullptr) {
    triangles.reserve(made->mesh.triangles.size());
    for (const auto& t : made->mesh.triangles) {
      if (!isOutside(t)) triangles.push_back(named(sites, t, [&](std::size_t k) { return made->site[k]; }));
    }
    // The numbers of a mesh's triangles depend on the threads that made it.
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  }
  // The sites lie on one line, or beyond the range of a SiteMesh.
  OuterMesh(sites, allOf(sites)).appendBeyond({}, triangles);
  return triangles;
}

/// Completes the triangles of the vertices inside the domain to the Delaunay triangulation of all sites.
void addOuterTriangles(const ProposedCells& agreed, const TiedCells& tied, SiteMesh& mesh,
                       Triangles& triangles) {
  const auto count = agreed.sites.size();
  std::vector<std::uint32_t> cells;
  for (std::size_t cell = 0; cell < count; ++cell) {
    if (reachesOutside(agreed, tied, cell)) cells.push_back(static_cast<std::uint32_t>(cell));
  }
  const OuterMesh outer(agreed.sites, std::move(cells));
  const auto hull = outer.hullEdges();
  if (hull == 0) return;
  outer.appendBeyond(knownEdges(outer, triangles), triangles);
  // Euler's relation for a triangulation with that many sites on its hull.
  if (triangles.size() + 2 + hull == 2 * cornersOf(agreed, triangles)) return;
  // Cells joined by ties may lack an edge between the known triangles and the rest.
  triangles = {};
  triangles = allTriangles(mesh);
}

}  // namespace

Triangles dualTriangles(const ProposedCells& agreed, const TiedCells& tied, SiteMesh& mesh) {
  if (mesh.isMade() && mesh.get() != nullptr) return allTriangles(mesh);
  const auto plain = plainVertices(agreed, tied);
  Triangles triangles;
  // By Euler's formula there are no more, so adding others never reallocates.
  triangles.reserve(2 * agreed.sites.size());
  append(agreed.sites.size(), agreed.threads, triangles,
         [&](std::size_t cell, const auto& put) { forTriangles(agreed, tied, plain, cell, put); });
  std::atomic<bool> proper = true;
  append(plain.size(), agreed.threads, triangles, [&](std::size_t vertex, const auto& put) {
    if (plain[vertex] != 0 || tied.walls[vertex] != 0) return;
    std::vector<std::uint32_t> around;
    if (!cellsAround(agreed, tied, vertex, around) ||
        !forTriangulated(agreed.sites, around, tied.position[vertex], put))
      proper = false;
  });
  if (!proper) {
    triangles = {};
    return allTriangles(mesh);
  }
  addOuterTriangles(agreed, tied, mesh, triangles);
  return triangles;
}

}  // namespace vorpipe::core
