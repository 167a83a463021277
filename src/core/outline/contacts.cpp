#include "core/outline/contacts.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "core/geometry/line_predicates.h"
#include "core/geometry/vertex_position.h"
#include "core/geometry/wall_predicates.h"
#include "core/vertices/cell_record.h"

namespace vorpipe::core {
namespace {

/// From as many on, the index is faster than to go through all.
constexpr std::size_t many_edges = 64;

/// Whether p is nearer than `margin` along both axes to the box of a and b.
bool isNearBox(Point a, Point b, double margin, Point p) {
  return p.x >= std::min(a.x, b.x) - margin && p.x <= std::max(a.x, b.x) + margin &&
         p.y >= std::min(a.y, b.y) - margin && p.y <= std::max(a.y, b.y) + margin;
}

}  // namespace

WeightedPoint ContactFinder::site(std::int32_t cell) const {
  const auto i = static_cast<std::size_t>(cell);
  return {{run_.set.x[i], run_.set.y[i]}, run_.set.weight.empty() ? 0 : run_.set.weight[i]};
}

/// A neighbor of a cell by its index in the set, or a wall.
std::int32_t ContactFinder::inSet(std::uint32_t cell, std::int64_t neighbor) const {
  if (neighbor < 0) return static_cast<std::int32_t>(neighbor);
  const auto row = run_.rows.edges(cell);
  const auto found = std::ranges::find_if(
      row, [&](std::int32_t other) { return outsideIndex(run_.set, other) == neighbor; });
  assert(found != row.end());  // a cell has edges with those of its row, and ties only take some away
  return *found;
}

/// A filter: whether ties may have moved p, or the line, off each other.
bool ContactFinder::isNearLine(Point a, Point b, Point p) const {
  const double dx = b.x - a.x, dy = b.y - a.y;
  return std::abs(dx * (p.y - a.y) - dy * (p.x - a.x)) <= margin_ * (std::abs(dx) + std::abs(dy));
}

/// Whether p is as near to the site of the cell as to a neighbor, or lies on a wall.
bool ContactFinder::isOnBorder(const CellSides& sides, std::int64_t neighbor, Point p) const {
  const auto other = inSet(sides.cell, neighbor);
  if (other >= 0) return nearerOf(site(static_cast<std::int32_t>(sides.cell)), site(other), p) == 0;
  return (isVerticalWall(other) ? p.x : p.y) == wallCoordinate(run_.set.domain, other);
}

/// Whether the vertex k lies at p, where not rounded.
bool ContactFinder::isVertex(const CellSides& sides, std::size_t k, Point p) const {
  return isNearBox(sides.from(k), sides.from(k), margin_, p) && isOnBorder(sides, sides.before(k), p) &&
         isOnBorder(sides, sides.neighbors[k], p);
}

/// Whether p lies between the ends of a side: on it as rounded, or on the bisector that it is a part of.
bool ContactFinder::isOnSide(const CellSides& sides, std::size_t k, Point p) const {
  const Point a = sides.from(k), b = sides.to(k);
  if (!isNearBox(a, b, margin_, p) || p == a || p == b) return false;
  if (!isNearLine(a, b, p) || !isBetween(a, b, p)) return false;
  return orientation(a, b, p) == 0 || (sides.neighbors[k] >= 0 && isOnBorder(sides, sides.neighbors[k], p));
}

/// Whether the vertex k, where not rounded, lies on the line through p and q.
bool ContactFinder::isOnLine(const CellSides& sides, std::size_t k, Point p, Point q) const {
  auto before = inSet(sides.cell, sides.before(k)), after = inSet(sides.cell, sides.neighbors[k]);
  const auto here = site(static_cast<std::int32_t>(sides.cell));
  if (before < 0) std::swap(before, after);
  if (before < 0) return false;  // a corner of the domain, which is not rounded
  if (after >= 0) return isCenterOnLine(p, q, here, site(before), site(after));
  const double wall = wallCoordinate(run_.set.domain, after);
  if (isVerticalWall(after)) return isOnLineAtWall(p, q, here, site(before), wall);
  const auto swapped = [](Point from) { return Point{from.y, from.x}; };
  const auto beside = site(before);
  return isOnLineAtWall(swapped(p), swapped(q), {swapped(here), here.weight},
                        {swapped(beside), beside.weight}, wall);
}

/// Whether p lies in each wall that the vertex lies in. Ties may have joined a vertex to a wall beside it,
/// off which it must not move.
bool ContactFinder::keepsWalls(Point vertex, Point p) const {
  const Box& box = run_.set.domain;
  return (vertex.x == p.x || (vertex.x != box.xmin && vertex.x != box.xmax)) &&
         (vertex.y == p.y || (vertex.y != box.ymin && vertex.y != box.ymax));
}

/// Where the vertex k is without ties, rounded.
Point ContactFinder::placeOf(const CellSides& sides, std::size_t k) const {
  return positionOf(cornerPosition(run_.set, static_cast<std::int32_t>(sides.cell),
                                   inSet(sides.cell, sides.before(k)),
                                   inSet(sides.cell, sides.neighbors[k])));
}

void ContactFinder::findCorner(const CellSides& sides, Point corner, Contacts& found) const {
  bool meets = false;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (sides.from(k) == corner) {
      meets = true;
      found.moved.push_back({corner, corner, true});
    } else if (keepsWalls(sides.from(k), corner) && isVertex(sides, k, corner)) {
      found.moved.push_back({sides.from(k), corner, true});
    } else {
      meets = meets || isOnSide(sides, k, corner);
    }
  }
  if (meets && (found.cells.empty() || found.cells.back() != sides.cell)) found.cells.push_back(sides.cell);
}

/// Finds edges in the middle of which a corner of another one lies: rings may touch in points.
void ContactFinder::findTouching(Point corner, std::span<const std::uint32_t> near, Contacts& found) {
  if (near.size() > many_edges) {
    index_.edgesIn({corner.x, corner.y, corner.x, corner.y}, at_corner_);
    near = at_corner_;
  }
  for (const auto edge : near) {
    const Point p = rings_.points[edge], q = rings_.points[rings_.next(edge)];
    if (!isNearBox(p, q, 0, corner) || p == corner || q == corner) continue;
    if (orientation(p, q, corner) == 0) found.nodes.push_back({edge, corner});
  }
}

void ContactFinder::findOnEdge(const CellSides& sides, std::uint32_t edge, Contacts& found) const {
  const Point p = rings_.points[edge], q = rings_.points[rings_.next(edge)];
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Point vertex = sides.from(k);
    if (!isNearBox(p, q, margin_, vertex) || !isNearLine(p, q, vertex)) continue;
    if (vertex == p || vertex == q || !isBetween(p, q, vertex)) continue;
    if (orientation(p, q, vertex) == 0) {
      found.nodes.push_back({edge, vertex});
    } else if (isOnLine(sides, k, p, q)) {
      const Point place = placeOf(sides, k);
      if (!keepsWalls(vertex, place)) continue;
      found.nodes.push_back({edge, vertex});
      found.moved.push_back({vertex, place, false});
    }
  }
}

void ContactFinder::find(const CellSides& sides, std::span<const std::uint32_t> near, Contacts& found) {
  const Box box = boxOf(sides.vertices);
  for (const auto edge : near) {
    const Point corner = rings_.points[edge];
    if (isNearBox({box.xmin, box.ymin}, {box.xmax, box.ymax}, margin_, corner)) {
      findCorner(sides, corner, found);
      findTouching(corner, near, found);
    }
    findOnEdge(sides, edge, found);
  }
}

bool ContactFinder::insertCorners(const CellSides& sides, std::span<const std::uint32_t> near,
                                  std::vector<Point>& vertices, std::vector<std::int64_t>& neighbors) {
  const Box box = boxOf(sides.vertices);
  corners_.clear();
  for (const auto edge : near) {
    const Point corner = rings_.points[edge];
    if (isNearBox({box.xmin, box.ymin}, {box.xmax, box.ymax}, margin_, corner)) corners_.push_back(corner);
  }
  vertices.clear();
  neighbors.clear();
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Point a = sides.from(k), b = sides.to(k);
    on_side_.assign(1, a);
    for (const Point corner : corners_) {
      if (isOnSide(sides, k, corner)) on_side_.push_back(corner);
    }
    std::ranges::sort(on_side_.begin() + 1, on_side_.end(), {}, [&](Point p) { return placeAlong(a, b, p); });
    on_side_.erase(std::unique(on_side_.begin(), on_side_.end()), on_side_.end());
    vertices.insert(vertices.end(), on_side_.begin(), on_side_.end());
    neighbors.resize(vertices.size(), sides.neighbors[k]);
  }
  return vertices.size() > sides.size();
}

std::vector<MovedVertex> agreed(std::vector<MovedVertex> moved) {
  // A corner comes first, then where the vertex is.
  std::ranges::sort(moved, {}, [](const MovedVertex& m) {
    return std::tuple(m.from.x, m.from.y, !m.to_corner, m.to != m.from, m.to.x, m.to.y);
  });
  const auto rest = std::ranges::unique(moved, {}, &MovedVertex::from);
  moved.erase(rest.begin(), rest.end());
  std::erase_if(moved, [](const MovedVertex& m) { return m.to == m.from; });
  return moved;
}

Point movedPlace(std::span<const MovedVertex> moved, Point vertex) {
  const auto found = std::ranges::lower_bound(moved, vertex, isLess, &MovedVertex::from);
  return found != moved.end() && found->from == vertex ? found->to : vertex;
}

}  // namespace vorpipe::core
