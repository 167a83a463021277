#include "domain/group_clipper.h"

#include <algorithm>

#include "backend/tie.h"
#include "domain/clean_rings.h"

namespace vorpipe::core {

GroupClipper::GroupClipper(const ClippedRun& run, const ScaledDiagram& cells, const OutlineIndex& index,
                           ClippedCells& out)
    : run_(run),
      cells_(cells),
      index_(index),
      clip_(index),
      out_(out),
      margin_(farthest_moved * shorterSide(cells.domain())),
      finder_(run, index, margin_) {}

void GroupClipper::group(std::size_t first, std::size_t last, std::vector<std::uint32_t>& near,
                         Contacts& found) {
  collect(first, last);
  if (members_.empty()) return;
  findEdges(points_);
  if (near_.empty()) {
    const Fate fate = fateOf(points_[0]);
    for (const auto& member : members_) out_.fate[member.site] = fate;
    return;
  }
  for (const auto& member : members_) {
    const auto sides = sidesOf(member);
    findEdges(sides.vertices);
    auto& fate = out_.fate[member.site];
    if (near_.empty() || member.count == 1) {
      fate = fateOf(sides.from(0));
    } else {
      finder_.find(sides, near_, found);
      fate = clip(sides.vertices, sides.neighbors);
      if (fate == Fate::cut && touchesItself(clipped_)) cleanRings(index_.rings(), near_, clipped_);
      if (fate == Fate::cut && !found.faults) found.faults = hasFaultsAtCrossings();
      if (fate == Fate::cut) fate = keepPart(member.site);
    }
    if (!near_.empty()) near.push_back(member.cell);
  }
}

void GroupClipper::again(std::uint32_t cell, std::span<const MovedVertex> moved,
                         std::span<const SideNode> nodes, RoundedNodes& found) {
  collect(cell, cell + std::size_t{1});
  if (members_.empty() || members_[0].count == 1) return;
  const bool leaves_walls = leaveWalls(moved);
  const auto sides = sidesOf(members_[0]);
  findEdges(sides.vertices);
  const bool has_corners = finder_.insertCorners(sides, near_, nodes, refined_) || leaves_walls;
  auto& fate = out_.fate[members_[0].site];
  fate = clip(refined_.vertices, refined_.neighbors);
  if (fate == Fate::inside && refined_.vertices.size() < 3 && runsAlongOutline(refined_.vertices)) {
    fate = Fate::outside;
  } else if (fate == Fate::inside && has_corners) {
    clipped_ = {refined_.vertices, refined_.neighbors, {0}, {false}, {}};
    fate = keepPart(members_[0].site);
  } else if (fate == Fate::cut) {
    cleanRings(index_.rings(), near_, clipped_);
    fate = keepPart(members_[0].site);
  }
  if (fate == Fate::cut) findRounded(sides, found);
}

/// Whether rounding the crossings has made the rings no longer simple: all else follows exact signs of the
/// input.
bool GroupClipper::hasFaultsAtCrossings() {
  rounded_.clear();
  for (const auto& crossing : clip_.crossings()) rounded_.push_back(crossing.at);
  std::ranges::sort(rounded_, isLess);
  asked_.clear();
  const auto isRounded = [&](Point p) { return std::ranges::binary_search(rounded_, p, isLess); };
  std::uint32_t first = 0;
  for (std::size_t r = 0; r < clipped_.ring_starts.size(); ++r) {
    const auto ring = clipped_.ring(r);
    bool before = isRounded(ring.back());
    for (std::uint32_t k = 0; k < ring.size(); ++k) {
      const bool here = isRounded(ring[k]);
      if (before || here)
        asked_.push_back(first + (k > 0 ? k - 1 : static_cast<std::uint32_t>(ring.size()) - 1));
      before = here;
    }
    first += static_cast<std::uint32_t>(ring.size());
  }
  faults_.clear();
  findFaults(clipped_, asked_, faults_);
  return !faults_.empty();
}

/// Edges that cross because of rounding pass an end of each other at less than the resolution of doubles.
/// There they must meet. Crossings stay where they are, whatever segments bend because of that.
void GroupClipper::findRounded(const CellSides& sides, RoundedNodes& found) {
  asked_.resize(clipped_.vertices.size());
  for (std::uint32_t e = 0; e < asked_.size(); ++e) asked_[e] = e;
  faults_.clear();
  findFaults(clipped_, asked_, faults_);
  if (faults_.empty()) return;
  for (const auto& crossing : clip_.crossings()) {
    addToEdge(crossing.edge, crossing.at, found);
    addToSide(sides, crossing.side, crossing.at, found);
  }
  for (const auto& [e, f] : faults_) {
    const Point a = clipped_.vertices[e], b = clipped_.endOf(e);
    const Point c = clipped_.vertices[f], d = clipped_.endOf(f);
    join(sides, a, b, c, found);
    join(sides, a, b, d, found);
    join(sides, c, d, a, found);
    join(sides, c, d, b, found);
  }
}

/// Inserts p into the segment from a to b, in the outline and in the cell, if doubles do not separate them.
void GroupClipper::join(const CellSides& sides, Point a, Point b, Point p, RoundedNodes& found) const {
  if (!isBetween(a, b, p) || !isNearForRounding(a, b, p)) return;
  const auto& rings = index_.rings();
  for (const auto edge : near_) {
    if (rings.points[edge] == a && rings.endOf(edge) == b) addToEdge(edge, p, found);
  }
  const Polygon parts{refined_.vertices};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (parts.from(k) == a && parts.to(k) == b) addToSide(sides, k, p, found);
  }
}

void GroupClipper::addToEdge(std::uint32_t edge, Point p, RoundedNodes& found) const {
  const auto& rings = index_.rings();
  if (p != rings.points[edge] && p != rings.endOf(edge)) found.on_edges.push_back({edge, p});
}

/// `part` counts the sides with nodes; the result refers to whole sides.
void GroupClipper::addToSide(const CellSides& sides, std::size_t part, Point p, RoundedNodes& found) const {
  const Polygon parts{refined_.vertices};
  if (p == parts.from(part) || p == parts.to(part)) return;
  const std::size_t k = refined_.part_of[part];
  const auto [a, b] = std::minmax({sides.from(k), sides.to(k)}, isLess);
  found.on_sides.push_back({a, b, p});
}

void GroupClipper::collect(std::size_t first_cell, std::size_t last_cell) {
  members_.clear();
  points_.clear();
  neighbors_.clear();
  for (auto cell = first_cell; cell < last_cell; ++cell) {
    const auto site = cells_.siteOf(cell);
    if (!cells_.hasCell(site)) continue;
    const std::size_t first = points_.size();
    cells_.appendCell(site, points_, neighbors_);
    // A cell whose edges are all ties has no edges.
    if (points_.size() == first) {
      points_.push_back(cells_.centroid(site));
      neighbors_.push_back(wall_outline);
    }
    members_.push_back({static_cast<std::uint32_t>(cell), site, first, points_.size() - first});
  }
}

/// Adds vertices to the only member, next to vertices that ties joined to walls: their positions without
/// ties. The sides between them count as the outline's. Returns whether there are any.
bool GroupClipper::leaveWalls(std::span<const MovedVertex> moved) {
  const auto sides = sidesOf(members_[0]);
  off_points_.clear();
  off_neighbors_.clear();
  const auto add = [&](Point p, std::int64_t neighbor) {
    off_points_.push_back(p);
    off_neighbors_.push_back(neighbor);
  };
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Point from = sides.from(k), off = movedPlace(moved, from);
    const bool after_wall = isOffWall(run_.set.domain, sides.before(k), off);
    const bool before_wall = isOffWall(run_.set.domain, sides.neighbors[k], off);
    if (before_wall && (k == 0 || sides.from(k - 1) != off)) add(off, wall_outline);
    const bool leaves = after_wall && sides.to(k) != off;
    add(from, leaves ? wall_outline : sides.neighbors[k]);
    if (leaves) add(off, sides.neighbors[k]);
  }
  if (off_points_.size() == points_.size()) return false;
  std::swap(points_, off_points_);
  std::swap(neighbors_, off_neighbors_);
  members_[0].count = points_.size();
  return true;
}

/// Finds edges that may contain any of these places, allowing for movement by ties.
void GroupClipper::findEdges(std::span<const Point> places) {
  const Box box = boxOf(places);
  index_.edgesIn({box.xmin - margin_, box.ymin - margin_, box.xmax + margin_, box.ymax + margin_}, near_);
}

/// Whether a cell that rounding has left no width lies on an edge of the outline.
bool GroupClipper::runsAlongOutline(std::span<const Point> cell) const {
  return std::ranges::any_of(near_, [&](std::uint32_t e) {
    const Point p = index_.rings().points[e], q = index_.rings().endOf(e);
    return (p == cell.front() && q == cell.back()) || (q == cell.front() && p == cell.back());
  });
}

CellSides GroupClipper::sidesOf(const Member& member) const {
  return {{std::span(points_).subspan(member.first, member.count)},
          member.cell,
          std::span(neighbors_).subspan(member.first, member.count)};
}

Fate GroupClipper::clip(std::span<const Point> vertices, std::span<const std::int64_t> neighbors) {
  switch (clip_.clip(vertices, neighbors, near_, clipped_)) {
    case OutlineClip::Outcome::inside:
      return Fate::inside;
    case OutlineClip::Outcome::outside:
      return Fate::outside;
    case OutlineClip::Outcome::cut:
      return Fate::cut;
    case OutlineClip::Outcome::crossed:
      break;
  }
  return traceBorder(vertices, neighbors);
}

/// Keeps the remaining part of a cell that ties or rounding have made cross itself.
Fate GroupClipper::traceBorder(std::span<const Point> vertices, std::span<const std::int64_t> neighbors) {
  clip_.border(vertices, near_, border_);
  clipped_.clear();
  std::vector<Point> ends;
  for (const auto& [from, to, side] : border_) {
    clipped_.vertices.push_back(from);
    clipped_.neighbors.push_back(side == no_crossing ? wall_outline : neighbors[side]);
    ends.push_back(to);
  }
  auto sorted_begins = clipped_.vertices, sorted_ends = ends;
  std::ranges::sort(sorted_begins, isLess);
  std::ranges::sort(sorted_ends, isLess);
  // Below the range of the predicates, the signs of edges that meet are inconsistent.
  if (sorted_begins != sorted_ends) return fateOf(vertices[0]);
  cleanRings(index_.rings(), near_, std::move(ends), clipped_);
  return clipped_.vertices.empty() ? Fate::outside : Fate::cut;
}

/// Keeps the remaining part of a cell, if any.
Fate GroupClipper::keepPart(std::uint32_t site) {
  if (clipped_.vertices.empty()) return Fate::outside;
  out_.parts[site] = std::make_unique<ClippedCell>(clipped_);
  out_.parts[site]->sortEdges();
  return Fate::cut;
}

}  // namespace vorpipe::core
