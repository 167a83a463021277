#include "cells/outer_triangles.h"

#include <algorithm>
#include <numeric>
#include <utility>

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
bool isOpen(const ProposedCells& agreed, const TiedCells& tied, std::size_t cell) {
  const auto row = agreed.cells.edges(cell);
  if (row.empty() || std::any_of(row.begin(), row.end(), [](auto n) { return n < 0; })) return true;
  if (!tied.has(cell)) return false;
  const auto k = tied.entry[cell];
  return std::any_of(tied.vertex.begin() + static_cast<std::ptrdiff_t>(tied.offsets[k]),
                     tied.vertex.begin() + static_cast<std::ptrdiff_t>(tied.offsets[k + 1]),
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

}  // namespace

void addOuterTriangles(const ProposedCells& agreed, const TiedCells& tied, SiteMesh& mesh,
                       Triangles& triangles) {
  const auto count = agreed.sites.size();
  std::vector<std::uint32_t> cells;
  for (std::size_t cell = 0; cell < count; ++cell) {
    if (isOpen(agreed, tied, cell)) cells.push_back(static_cast<std::uint32_t>(cell));
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
  std::vector<std::uint32_t> all(sites.size());
  std::iota(all.begin(), all.end(), 0u);
  OuterMesh(sites, std::move(all)).appendBeyond({}, triangles);
  return triangles;
}

}  // namespace vorpipe::core
