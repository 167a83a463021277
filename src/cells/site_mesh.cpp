#include "cells/site_mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "backend/collect.h"
#include "base/parallel.h"
#include "geometry/curve_order.h"
#include "geometry/triangulation.h"
#include "geometry/vertex_position.h"
#include "geometry/vertex_predicates.h"

namespace vorpipe::core {
namespace {

/// Signed 32-bit integers number the triangles, two for each site.
constexpr std::size_t most_mesh_sites = std::size_t{1} << 29;

/// Whether coordinates and their differences are in the range of predicates.h: coordinates up to 2^240 are
/// multiples of 2^-200, and two larger ones differ by at least 2^-53 of the smaller.
bool isInRange(const SiteSet& sites) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  const auto look = [&](double coordinate) {
    const double size = std::abs(coordinate);
    if (size > 0) least = std::min(least, size);
    most = std::max(most, size);
  };
  std::for_each(sites.x.begin(), sites.x.end(), look);
  std::for_each(sites.y.begin(), sites.y.end(), look);
  for (const auto wall : {sites.domain.xmin, sites.domain.xmax, sites.domain.ymin, sites.domain.ymax})
    look(wall);
  return most <= 0x1p240 || (sites.weight.empty() && most <= 0x1p300 && least >= 0x1p-83);
}

bool areInRange(const std::vector<double>& weights) {
  return std::all_of(weights.begin(), weights.end(), [](double weight) {
    const double size = std::abs(weight);
    return size == 0 || (size >= 0x1p-440 && size <= 0x1p480);
  });
}

/// The neighbor, in a ring, across the arc at infinity that closes an unbounded cell.
constexpr std::int32_t infinity = -5;

constexpr std::size_t none = 3;

/// Which corner of a triangle is a site, or none.
std::size_t cornerOf(const MeshTriangle& triangle, std::int32_t site) {
  const auto& corner = triangle.corner;
  return corner[0] == site ? 0 : (corner[1] == site ? 1 : (corner[2] == site ? 2 : none));
}

std::size_t next(std::size_t k) { return k == 2 ? 0 : k + 1; }

constexpr std::size_t mesh_cells_grain = std::size_t{1} << 14;
/// Nearly all cells have at most this many neighbors.
constexpr std::size_t most_neighbors = 32;

/// By triangle of a mesh: the walls on or beyond which its power center lies, computed at the first use,
/// unless floating point proves that there is none. Thread safe.
class WallsOfTriangles {
 public:
  WallsOfTriangles(const SiteSet& sites, const PartMesh& part, int threads)
      : walls_(part.mesh.triangles.size()) {
    parallelFor(walls_.size(), mesh_cells_grain, threads, [&](std::size_t begin, std::size_t end) {
      const Inside inside(sites, part);
      for (auto t = begin; t < end; ++t) walls_[t] = inside.isSure(part.mesh.triangles[t]) ? 0 : unknown;
    });
  }

  template <class Find>
  std::uint8_t of(std::int32_t triangle, const Find& find) {
    const std::atomic_ref walls(walls_[static_cast<std::size_t>(triangle)]);
    auto known = walls.load(std::memory_order_relaxed);
    if (known == unknown) walls.store(known = find(), std::memory_order_relaxed);
    return known;
  }

  /// Whether it is known that there are none.
  [[nodiscard]] bool areNone(std::int32_t triangle) {
    return std::atomic_ref(walls_[static_cast<std::size_t>(triangle)]).load(std::memory_order_relaxed) == 0;
  }

 private:
  static constexpr std::uint8_t unknown = 255;

  /// Finds power centers that surely lie inside the domain, by far more than rounding moves them. The three
  /// sites must be no farther apart than a few sides of the domain, and not form a thin triangle.
  class Inside {
   public:
    Inside(const SiteSet& sites, const PartMesh& part) : part_(part) {
      const Box& d = sites.domain;
      const double side = std::max(d.xmax - d.xmin, d.ymax - d.ymin), margin = 1e-6 * side;
      box_ = {d.xmin + margin, d.ymin + margin, d.xmax - margin, d.ymax - margin};
      most_ = 16 * side * side;
    }

    [[nodiscard]] bool isSure(const MeshTriangle& t) const {
      if ((t.corner[0] | t.corner[1] | t.corner[2]) < 0) return false;
      const auto a = static_cast<std::size_t>(t.corner[0]), b = static_cast<std::size_t>(t.corner[1]),
                 c = static_cast<std::size_t>(t.corner[2]);
      const auto& p = part_.points;
      const Point u{p[b].x - p[a].x, p[b].y - p[a].y}, v{p[c].x - p[a].x, p[c].y - p[a].y};
      double uu = u.x * u.x + u.y * u.y, vv = v.x * v.x + v.y * v.y;
      const double twice = 2 * (u.x * v.y - u.y * v.x), size = uu + vv;
      if (!part_.weights.empty()) {
        const auto& w = part_.weights;
        if (!(std::abs(w[b] - w[a]) + std::abs(w[c] - w[a]) < size)) return false;
        uu += w[a] - w[b];
        vv += w[a] - w[c];
      }
      const double x = p[a].x + (v.y * uu - u.y * vv) / twice, y = p[a].y + (u.x * vv - v.x * uu) / twice;
      return twice > 1e-6 * size && size < most_ && x > box_.xmin && x < box_.xmax && y > box_.ymin &&
             y < box_.ymax;
    }

   private:
    const PartMesh& part_;
    Box box_{};
    double most_;
  };

  std::vector<std::uint8_t> walls_;
};

class MeshCellFinder {
 public:
  MeshCellFinder(const SiteSet& sites, const PartMesh& part, WallsOfTriangles& walls)
      : sites_(sites), part_(part), mesh_(part.mesh), walls_(walls) {}

  /// Appends the neighbors of the cell of a point of the mesh, by index in the set.
  CellStatus find(std::uint32_t point, BigVector<std::int32_t>& neighbors) {
    cell_ = static_cast<std::int32_t>(point);
    if (isInside(neighbors)) return CellStatus::certified;
    const auto& triangle = mesh_.triangles[static_cast<std::size_t>(mesh_.at[point])];
    if (cornerOf(triangle, cell_) == none) {
      for (const auto corner : triangle.corner) neighbors.push_back(siteOf(corner));
      return CellStatus::empty;
    }
    walkAround();
    if (reached_ != 0) {
      for (const auto wall : {wall_xmin, wall_xmax, wall_ymin, wall_ymax}) {
        if (cutAt(static_cast<std::int32_t>(wall))) continue;
        if (!sites_.weight.empty()) putProof(neighbors);
        return CellStatus::empty;
      }
    }
    for (const auto& edge : ring_)
      neighbors.push_back(edge.neighbor < 0 ? edge.neighbor : siteOf(edge.neighbor));
    return CellStatus::certified;
  }

 private:
  struct Edge {
    std::int32_t neighbor;  ///< a site, a wall, or infinity
    std::uint8_t
        reached;  ///< walls on or beyond which it begins; set if this neighbor and the one before are sites
  };

  [[nodiscard]] WeightedPoint at(std::int32_t point) const {
    const auto i = static_cast<std::size_t>(point);
    return {part_.points[i], part_.weights.empty() ? 0 : part_.weights[i]};
  }
  [[nodiscard]] std::int32_t siteOf(std::int32_t point) const {
    return point == ghost ? ghost : static_cast<std::int32_t>(part_.site[static_cast<std::size_t>(point)]);
  }

  /// Appends the neighbors of a cell that is known to reach no wall. Returns false and appends nothing for
  /// other cells, and for cells with very many neighbors.
  bool isInside(BigVector<std::int32_t>& neighbors) {
    const auto size = neighbors.size();
    neighbors.resize(size + most_neighbors);
    auto* const found = neighbors.data() + size;
    std::size_t count = 0;
    const auto first = mesh_.at[static_cast<std::size_t>(cell_)];
    auto t = first;
    do {
      const auto& triangle = mesh_.triangles[static_cast<std::size_t>(t)];
      const auto k = cornerOf(triangle, cell_);
      if (k == none || !walls_.areNone(t) || count == most_neighbors) {
        neighbors.resize(size);
        return false;
      }
      found[count++] = siteOf(triangle.corner[k == 0 ? 2 : k - 1]);
      t = triangle.neighbor[next(k)];
    } while (t != first);
    neighbors.resize(size + count);
    return true;
  }

  /// Appends the neighbors of the unclipped cell, which lies beyond the domain.
  void putProof(BigVector<std::int32_t>& neighbors) {
    walkAround();
    for (const auto& edge : ring_) {
      if (edge.neighbor >= 0) neighbors.push_back(siteOf(edge.neighbor));
    }
  }

  /// Lists the unclipped cell, whose vertices are the power centers of its triangles.
  void walkAround() {
    ring_.clear();
    reached_ = 0;
    const auto first = mesh_.at[static_cast<std::size_t>(cell_)];
    auto t = first;
    do {
      const auto& triangle = mesh_.triangles[static_cast<std::size_t>(t)];
      const auto k = cornerOf(triangle, cell_);
      const auto before = triangle.corner[next(k)], after = triangle.corner[next(next(k))];
      std::uint8_t reached = 0;
      if (before == ghost || after == ghost) {
        reached_ = all_walls;
      } else {
        reached = walls_.of(t, [&] { return wallsReached(sites_.domain, at(cell_), at(before), at(after)); });
        reached_ |= reached;
      }
      ring_.push_back({after == ghost ? infinity : after, reached});
      t = triangle.neighbor[next(k)];
    } while (t != first);
  }

  /// Cuts off the part beyond a wall. Returns false if nothing is left.
  bool cutAt(std::int32_t wall) {
    if ((reached_ & wallBit(wall)) == 0) return true;
    const auto count = ring_.size();
    beyond_.resize(count);
    for (std::size_t e = 0; e < count; ++e) {
      beyond_[e] = isBeyond(wall, ring_[e > 0 ? e - 1 : count - 1], ring_[e]) ? 1 : 0;
    }
    const auto some = std::find(beyond_.begin(), beyond_.end(), 0);
    if (some == beyond_.end()) return false;
    // The cell is convex, so the vertices beyond are consecutive.
    std::rotate(ring_.begin(), ring_.begin() + (some - beyond_.begin()), ring_.end());
    std::rotate(beyond_.begin(), some, beyond_.end());
    const auto begin = std::find(beyond_.begin(), beyond_.end(), 1);
    if (begin == beyond_.end()) return true;
    const auto end = std::find(begin, beyond_.end(), 0);
    // The last edge of those that begin beyond ends inside.
    const auto first = ring_.begin() + (begin - beyond_.begin());
    ring_.erase(first, first + (end - begin - 1));
    ring_.insert(first, Edge{wall, 0});
    return true;
  }

  /// Whether the vertex at which an edge begins, where the one before ends, lies on or beyond a wall.
  [[nodiscard]] bool isBeyond(std::int32_t wall, const Edge& before, const Edge& edge) const {
    if (before.neighbor >= 0 && edge.neighbor >= 0) return (edge.reached & wallBit(wall)) != 0;
    if (before.neighbor == infinity) return isBeyondFar(wall, edge.neighbor, -1);
    if (edge.neighbor == infinity) return isBeyondFar(wall, before.neighbor, 1);
    const auto other = std::max(before.neighbor, edge.neighbor);
    const auto crossed = std::min(before.neighbor, edge.neighbor);
    // Two walls meet in a corner of the domain; and the opposite wall is nowhere beyond this one.
    if (other < 0 || isVerticalWall(crossed) == isVerticalWall(wall)) return false;
    return crossesBeyond(wall, crossed, other);
  }

  /// Whether the bisector with `other` meets the wall `crossed` on or beyond `wall`: decided by which of the
  /// two sites is nearer to the corner of both walls.
  [[nodiscard]] bool crossesBeyond(std::int32_t wall, std::int32_t crossed, std::int32_t other) const {
    const auto a = at(cell_), b = at(other);
    const bool upright = isVerticalWall(crossed);
    const auto vertical = upright ? crossed : wall, level = upright ? wall : crossed;
    const Point corner{wallCoordinate(sites_.domain, vertical), wallCoordinate(sites_.domain, level)};
    const int nearer = nearerOf(a, b, corner);
    const bool ahead = upright ? b.y > a.y : b.x > a.x;
    // If the corner is nearer to a, the bisector passes it on the side of b.
    const int passes = ahead ? -nearer : nearer;
    return outward(wall) * passes >= 0;
  }

  /// Whether an unbounded edge, forward (1) or backward (-1), ends beyond a wall.
  [[nodiscard]] bool isBeyondFar(std::int32_t wall, std::int32_t edge, int direction) const {
    const bool vertical = isVerticalWall(wall);
    if (edge < 0) {
      if (isVerticalWall(edge) == vertical) return false;
      // Along the walls of the domain, counter-clockwise.
      const bool ascending = edge == wall_xmax || edge == wall_ymin;
      return outward(wall) * direction * (ascending ? 1 : -1) > 0;
    }
    const auto a = at(cell_), b = at(edge);
    const int turned = vertical ? sign(a.y, b.y) : sign(b.x, a.x);
    if (turned != 0) return outward(wall) * direction * turned > 0;
    const double x = wallCoordinate(sites_.domain, wall);
    return outward(wall) * (vertical ? middleSide(a, b, x) : middleSide(swapped(a), swapped(b), x)) >= 0;
  }

  static WeightedPoint swapped(const WeightedPoint& p) { return {{p.y, p.x}, p.weight}; }

  static int sign(double larger, double smaller) {
    return larger > smaller ? 1 : (larger < smaller ? -1 : 0);
  }
  static constexpr std::uint8_t all_walls = 15;

  const SiteSet& sites_;
  const PartMesh& part_;
  const Mesh& mesh_;
  WallsOfTriangles& walls_;
  std::int32_t cell_ = 0;
  std::vector<Edge> ring_;
  std::vector<std::uint8_t> beyond_;  ///< by edge of the ring: whether it begins there
  std::uint8_t reached_ = 0;          ///< walls that some vertex lies on or beyond
};

}  // namespace

std::vector<std::uint32_t> allOf(const SiteSet& sites) {
  std::vector<std::uint32_t> all(sites.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

bool canTriangulate(const SiteSet& sites) {
  return sites.size() <= most_mesh_sites && isInRange(sites) && areInRange(sites.weight);
}

PartMesh triangulate(const SiteSet& sites, std::vector<std::uint32_t> which, int threads) {
  constexpr std::size_t grain = std::size_t{1} << 15;
  PartMesh part;
  part.site = std::move(which);
  sortAlongCurve(sites, part.site, threads);
  part.points.resize(part.site.size());
  part.weights.resize(sites.weight.empty() ? 0 : part.site.size());
  parallelFor(part.site.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto k = begin; k < end; ++k) part.points[k] = {sites.x[part.site[k]], sites.y[part.site[k]]};
    if (part.weights.empty()) return;
    for (auto k = begin; k < end; ++k) part.weights[k] = sites.weight[part.site[k]];
  });
  part.mesh = delaunay(part.points, part.weights, threads);
  return part;
}

bool SiteMesh::isPossible() {
  if (!possible_) possible_ = canTriangulate(sites_);
  return *possible_;
}

const PartMesh* SiteMesh::get() {
  if (!mesh_) {
    mesh_.emplace();
    if (isPossible()) mesh_ = triangulate(sites_, allOf(sites_), threads_);
  }
  return mesh_->mesh.triangles.empty() ? nullptr : &*mesh_;
}

std::vector<MeshCells> meshCells(const SiteSet& sites, const PartMesh& part,
                                 std::span<const std::uint8_t> is_wanted, int threads) {
  constexpr std::size_t usual_neighbors = 7;
  WallsOfTriangles walls(sites, part, threads);
  std::vector<MeshCells> parts((part.site.size() + mesh_cells_grain - 1) / mesh_cells_grain);
  parallelFor(part.site.size(), mesh_cells_grain, threads, [&](std::size_t begin, std::size_t end) {
    auto& [site, cells] = parts[begin / mesh_cells_grain];
    MeshCellFinder finder(sites, part, walls);
    std::copy_if(part.site.begin() + static_cast<std::ptrdiff_t>(begin),
                 part.site.begin() + static_cast<std::ptrdiff_t>(end), std::back_inserter(site),
                 [&](std::uint32_t each) { return is_wanted[each] != 0; });
    cells.status.reserve(site.size());
    cells.offsets.reserve(site.size() + 1);
    cells.neighbor.reserve(usual_neighbors * site.size() + most_neighbors);
    cells.offsets.push_back(0);
    for (auto point = begin; point < end; ++point) {
      if (is_wanted[part.site[point]] == 0) continue;
      cells.status.push_back(finder.find(static_cast<std::uint32_t>(point), cells.neighbor));
      beginAtFirst(std::span(cells.neighbor).subspan(cells.offsets.back()));
      cells.offsets.push_back(cells.neighbor.size());
    }
  });
  return parts;
}

}  // namespace vorpipe::core
