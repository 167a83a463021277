#include "domain/contacts.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "cells/cell_record.h"
#include "geometry/vertex_position.h"
#include "geometry/vertex_predicates.h"

namespace vorpipe::core {
namespace {

/// From this many edges on, the index is faster than testing all.
constexpr std::size_t many_edges = 64;

/// Whether p is nearer than `margin` along both axes to the box of a and b.
bool isNearBox(Point a, Point b, double margin, Point p) {
  return p.x >= std::min(a.x, b.x) - margin && p.x <= std::max(a.x, b.x) + margin &&
         p.y >= std::min(a.y, b.y) - margin && p.y <= std::max(a.y, b.y) + margin;
}

/// The point of the line through p and q that is nearest to another.
Point footOf(Point p, Point q, Point from) {
  const double along = alongWay(p, q, from) / alongWay(p, q, q);
  return {p.x + along * (q.x - p.x), p.y + along * (q.y - p.y)};
}

/// Whether a point is a corner of the domain: no tie removes these from a cell.
bool isCorner(const Box& domain, Point p) {
  return (p.x == domain.xmin || p.x == domain.xmax) && (p.y == domain.ymin || p.y == domain.ymax);
}

/// Nodes are sorted by their sides.
using SideOrder = std::tuple<double, double, double, double>;
SideOrder sideOrder(Point a, Point b) { return {a.x, a.y, b.x, b.y}; }
SideOrder orderOf(const SideNode& node) { return sideOrder(node.a, node.b); }

}  // namespace

WeightedPoint ContactFinder::site(std::int32_t cell) const {
  const auto i = static_cast<std::size_t>(cell);
  return {{run_.set.x[i], run_.set.y[i]}, run_.set.weight.empty() ? 0 : run_.set.weight[i]};
}

/// A neighbor of a cell: its index in the set, or a wall.
std::int32_t ContactFinder::inSet(std::uint32_t cell, std::int64_t neighbor) const {
  if (neighbor < 0) return static_cast<std::int32_t>(neighbor);
  const auto row = run_.rows.edges(cell);
  const auto found = std::ranges::find_if(
      row, [&](std::int32_t other) { return outsideIndex(run_.set, other) == neighbor; });
  assert(found != row.end());  // a cell's neighbors are in its row; ties only remove some
  return *found;
}

/// A filter: whether p is so close to the line that ties may have moved either off the other.
bool ContactFinder::isNearLine(Point a, Point b, Point p) const {
  const double dx = b.x - a.x, dy = b.y - a.y;
  return std::abs(dx * (p.y - a.y) - dy * (p.x - a.x)) <= margin_ * (std::abs(dx) + std::abs(dy));
}

/// 1: p is nearer to the site of the cell than to the neighbor, or on the inner side of a wall; -1: it is
/// farther; 0: neither.
int ContactFinder::sideOfBorder(const CellSides& sides, std::int64_t neighbor, Point p) const {
  const auto other = inSet(sides.cell, neighbor);
  if (other >= 0) return -nearerOf(site(static_cast<std::int32_t>(sides.cell)), site(other), p);
  return isOffWall(run_.set.domain, neighbor, p) ? 1 : 0;
}

/// Whether the vertex k, before rounding, lies at p.
bool ContactFinder::isVertex(const CellSides& sides, std::size_t k, Point p) const {
  return isNearBox(sides.from(k), sides.from(k), margin_, p) &&
         sideOfBorder(sides, sides.before(k), p) == 0 && sideOfBorder(sides, sides.neighbors[k], p) == 0;
}

/// Whether p lies between the ends of a side: on its bisector, on the rounded side, or between the two.
bool ContactFinder::isOnSide(const CellSides& sides, std::size_t k, Point p) const {
  const Point a = sides.from(k), b = sides.to(k);
  if (!isNearBox(a, b, margin_, p) || p == a || p == b) return false;
  if (!isNearLine(a, b, p) || !isBetween(a, b, p)) return false;
  const int drawn = orientation(a, b, p);
  if (drawn == 0) return true;
  if (sides.neighbors[k] < 0) return false;
  const int exact = sideOfBorder(sides, sides.neighbors[k], p);
  return exact == 0 || (exact != drawn && isNearForRounding(a, b, p));
}

/// On which side of the line from p to q the vertex k lies before rounding, if known.
std::optional<int> ContactFinder::vertexSide(const CellSides& sides, std::size_t k, Point p, Point q) const {
  auto before = inSet(sides.cell, sides.before(k)), after = inSet(sides.cell, sides.neighbors[k]);
  const auto here = site(static_cast<std::int32_t>(sides.cell));
  if (before < 0) std::swap(before, after);
  if (before < 0) return {};  // a corner of the domain, which is not rounded
  if (after >= 0) return centerSide(p, q, here, site(before), site(after));
  const double wall = wallCoordinate(run_.set.domain, after);
  if (isVerticalWall(after)) return sideAtWall(p, q, here, site(before), wall);
  // Mirrored, so that the sides change.
  const auto swapped = [](Point from) { return Point{from.y, from.x}; };
  const auto beside = site(before);
  return sideAtWall(swapped(q), swapped(p), {swapped(here), here.weight}, {swapped(beside), beside.weight},
                    wall);
}

/// The rounded position of vertex k without ties.
Point ContactFinder::placeOf(const CellSides& sides, std::size_t k) const {
  return positionOf(cornerPosition(run_.set, static_cast<std::int32_t>(sides.cell),
                                   inSet(sides.cell, sides.before(k)),
                                   inSet(sides.cell, sides.neighbors[k])));
}

void ContactFinder::findCorner(const CellSides& sides, Point corner, Contacts& found) const {
  bool meets = false;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    // If not near the line, it is near neither to the side nor to its start point.
    if (!isNearLine(sides.from(k), sides.to(k), corner)) continue;
    if (sides.from(k) == corner) {
      meets = true;
      found.moved.push_back({corner, corner, MovedVertex::Target::corner});
    } else if (!isCorner(run_.set.domain, sides.from(k)) && isVertex(sides, k, corner)) {
      found.moved.push_back({sides.from(k), corner, MovedVertex::Target::corner});
    } else {
      meets = meets || isOnSide(sides, k, corner);
    }
  }
  if (meets && (found.cells.empty() || found.cells.back() != sides.cell)) found.cells.push_back(sides.cell);
}

/// Finds edges with a corner of another edge in their interior: rings may touch in points.
void ContactFinder::findTouching(Point corner, std::span<const std::uint32_t> near, Contacts& found) {
  if (near.size() > many_edges) {
    index_.edgesIn({corner.x, corner.y, corner.x, corner.y}, at_corner_);
    near = at_corner_;
  }
  for (const auto edge : near) {
    const Point p = rings_.points[edge], q = rings_.endOf(edge);
    if (!isNearBox(p, q, 0, corner) || p == corner || q == corner) continue;
    if (orientation(p, q, corner) == 0) found.nodes.push_back({edge, corner});
  }
}

/// Whether a side of the cell lies on the line through p and q: ties may have joined more sides at its end
/// than the two that meet there now.
bool ContactFinder::isInLine(const CellSides& sides, std::int64_t neighbor, Point p, Point q) const {
  return neighbor >= 0 && sideOfBorder(sides, neighbor, p) == 0 && sideOfBorder(sides, neighbor, q) == 0;
}

void ContactFinder::findOnEdge(const CellSides& sides, std::uint32_t edge, Contacts& found) const {
  const Point p = rings_.points[edge], q = rings_.endOf(edge);
  const auto move = [&](Point from, Point to, MovedVertex::Target target) {
    found.nodes.push_back({edge, to});
    found.moved.push_back({from, to, target});
  };
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Point vertex = sides.from(k);
    if (!isNearBox(p, q, margin_, vertex) || !isNearLine(p, q, vertex)) continue;
    if (vertex == p || vertex == q || !isBetween(p, q, vertex)) continue;
    const int drawn = orientation(p, q, vertex);
    if (drawn == 0) {
      found.nodes.push_back({edge, vertex});
      continue;
    }
    if (isCorner(run_.set.domain, vertex)) continue;
    const int exact = vertexSide(sides, k, p, q).value_or(drawn);
    if (exact == 0) {
      move(vertex, placeOf(sides, k), MovedVertex::Target::crossing);
    } else if (isInLine(sides, sides.before(k), p, q) || isInLine(sides, sides.neighbors[k], p, q)) {
      move(vertex, footOf(p, q, vertex), MovedVertex::Target::foot);
    } else if (exact != drawn && isNearForRounding(p, q, vertex)) {
      found.nodes.push_back({edge, vertex});
    }
  }
}

void ContactFinder::find(const CellSides& sides, std::span<const std::uint32_t> near, Contacts& found) {
  const Box box = boxOf(sides.vertices);
  for (const auto edge : near) {
    const Point corner = rings_.points[edge];
    if (isNearBox({box.xmin, box.ymin}, {box.xmax, box.ymax}, margin_, corner)) {
      findCorner(sides, corner, found);
      if (rings_.outer.size() > 1) findTouching(corner, near, found);
    }
    findOnEdge(sides, edge, found);
  }
}

bool ContactFinder::insertCorners(const CellSides& sides, std::span<const std::uint32_t> near,
                                  std::span<const SideNode> nodes, RefinedSides& refined) {
  const Box box = boxOf(sides.vertices);
  corners_.clear();
  for (const auto edge : near) {
    const Point corner = rings_.points[edge];
    if (isNearBox({box.xmin, box.ymin}, {box.xmax, box.ymax}, margin_, corner)) corners_.push_back(corner);
  }
  refined.vertices.clear();
  refined.neighbors.clear();
  refined.part_of.clear();
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const auto [a, b] = std::minmax({sides.from(k), sides.to(k)}, isLess);
    on_side_.assign(1, sides.from(k));
    for (const Point corner : corners_) {
      if (isOnSide(sides, k, corner)) on_side_.push_back(corner);
    }
    const auto side = sideOrder(a, b);
    const auto last = std::ranges::upper_bound(nodes, side, {}, orderOf);
    for (auto node = std::ranges::lower_bound(nodes, side, {}, orderOf); node != last; ++node) {
      on_side_.push_back(node->at);
    }
    std::ranges::sort(on_side_.begin() + 1, on_side_.end(), {},
                      [&](Point p) { return placeAlong(sides.from(k), sides.to(k), p); });
    on_side_.erase(std::unique(on_side_.begin(), on_side_.end()), on_side_.end());
    refined.vertices.insert(refined.vertices.end(), on_side_.begin(), on_side_.end());
    refined.neighbors.resize(refined.vertices.size(), sides.neighbors[k]);
    refined.part_of.resize(refined.vertices.size(), k);
  }
  return refined.vertices.size() > sides.size();
}

bool isOffWall(const Box& domain, std::int64_t neighbor, Point p) {
  if (neighbor >= 0 || neighbor == wall_outline) return false;
  const auto wall = static_cast<std::int32_t>(neighbor);
  return (isVerticalWall(wall) ? p.x : p.y) != wallCoordinate(domain, wall);
}

void sortNodes(std::vector<SideNode>& nodes) { std::ranges::sort(nodes, {}, orderOf); }

std::vector<MovedVertex> agreed(std::vector<MovedVertex> moved) {
  // The most accurate target comes first, then the vertex's present position.
  std::ranges::sort(moved, {}, [](const MovedVertex& m) {
    return std::tuple(m.from.x, m.from.y, m.target, m.to != m.from, m.to.x, m.to.y);
  });
  const auto isSame = [](const MovedVertex& a, const MovedVertex& b) { return a.from == b.from; };
  moved.erase(std::unique(moved.begin(), moved.end(), isSame), moved.end());
  std::erase_if(moved, [](const MovedVertex& m) { return m.to == m.from; });
  return moved;
}

Point movedPlace(std::span<const MovedVertex> moved, Point vertex) {
  const auto found = std::ranges::lower_bound(moved, vertex, isLess, &MovedVertex::from);
  return found != moved.end() && found->from == vertex ? found->to : vertex;
}

}  // namespace vorpipe::core
