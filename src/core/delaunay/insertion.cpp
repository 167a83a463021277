#include "core/delaunay/insertion.h"

#include <algorithm>
#include <utility>

namespace vorpipe::core {
namespace {

constexpr auto none = GrowingMesh::none;

std::size_t next(std::size_t k) { return k == 2 ? 0 : k + 1; }

/// For p on the line through a and b.
bool isBetween(Point a, Point b, Point p) {
  return a.x != b.x ? (a.x < p.x) == (p.x < b.x) : (a.y < p.y) == (p.y < b.y);
}

}  // namespace

Insertion::Insertion(GrowingMesh& mesh, Region region, std::int32_t first)
    : mesh_(mesh), region_(region), first_(first), last_(none) {}

Insertion::Insertion(GrowingMesh& mesh, std::int32_t start)
    : mesh_(mesh), region_(anywhere), first_(0), last_(start) {}

WeightedPoint Insertion::weighted(std::int32_t i) const {
  return {at(i), mesh_.weights[static_cast<std::size_t>(i)]};
}

bool Insertion::mayChange(std::int32_t t) const {
  return region_ == anywhere || mesh_.region[static_cast<std::size_t>(t)] == region_;
}

bool Insertion::mayLookAt(std::int32_t t) const {
  return mayChange(t) || mesh_.region[static_cast<std::size_t>(t)] == of_several;
}

/// Whether point i conflicts with triangle t: true strictly inside its circumcircle. For a ghost triangle
/// that circle is the half-plane outside its hull edge; true on the edge itself as well, unless weights hide
/// i there. False on the circle without weights.
///
/// With weights, ties are broken by a symbolic perturbation that scales all squared distances by 1 - e, for
/// an infinitesimal e > 0: its sign is that of the unweighted test, negated. So a point whose cell has no
/// area is hidden, independent of the order of insertion.
bool Insertion::conflicts(std::int32_t t, std::int32_t i) {
  const auto& corner = triangle(t).corner;
  for (std::size_t k = 0; k < 3; ++k) {
    if (corner[k] != ghost) continue;
    const auto a = corner[next(k)], b = corner[next(next(k))];
    const int side = orientation(at(a), at(b), at(i));
    return side > 0 || (side == 0 && conflictsOnLine(a, b, i));
  }
  const auto inPlain = [&] { return inCircle(at(corner[0]), at(corner[1]), at(corner[2]), at(i)); };
  if (mesh_.weights.empty()) return inPlain() > 0;
  const int inside = inCircle(weighted(corner[0]), weighted(corner[1]), weighted(corner[2]), weighted(i));
  return inside != 0 ? inside > 0 : inPlain() < 0;
}

/// For point i on the line through a and b: whether it conflicts with the ghost triangle of edge ab.
bool Insertion::conflictsOnLine(std::int32_t a, std::int32_t b, std::int32_t i) {
  const bool between = isBetween(at(a), at(b), at(i));
  if (mesh_.weights.empty()) return between;
  const int inside = inInterval(weighted(a), weighted(b), weighted(i));
  return inside != 0 ? inside > 0 : !between;
}

/// A triangle at an inserted point that precedes i closely in the order of points; else the newest triangle.
std::int32_t Insertion::nearby(std::int32_t i) {
  constexpr std::int32_t most_looked_at = 64;
  const auto first = std::max(i >= first_ ? first_ : 0, i - most_looked_at);
  while (--i >= first) {
    if (incident(i) != none) return incident(i);
  }
  return last_;
}

std::int32_t Insertion::locate(std::int32_t i) {
  const Point p = at(i);
  auto t = nearby(i), from = none;
  while (t != none && mayLookAt(t)) {
    const auto& here = triangle(t);
    const auto k = static_cast<std::size_t>(std::find(here.corner.begin(), here.corner.end(), ghost) -
                                            here.corner.begin());
    const bool is_outside = k < here.corner.size();
    if (is_outside && conflicts(t, i)) return t;
    const auto to = is_outside ? here.neighbor[k] : neighborTowards(p, t, from);
    if (to == t) return t;
    from = std::exchange(t, to);
  }
  return none;
}

/// The neighbor of t across an edge that separates t from p; t if it contains p. The walk came from triangle
/// `from`, which is skipped: p is not on its side.
std::int32_t Insertion::neighborTowards(Point p, std::int32_t t, std::int32_t from) {
  const auto& here = triangle(t);
  for (std::size_t k = 0; k < 3; ++k) {
    if (here.neighbor[k] == from) continue;
    if (orientation(at(here.corner[next(k)]), at(here.corner[next(next(k))]), p) < 0) return here.neighbor[k];
  }
  return t;
}

bool Insertion::insert(std::int32_t point, std::int32_t room) {
  leaveEmpty(room);
  leaveEmpty(room + 1);
  const auto first = locate(point);
  if (first == none) return false;
  if (!mesh_.weights.empty() && !conflicts(first, point)) {
    hidden.push_back(point);
    return true;
  }
  if (!findCavity(point, first)) {
    for (const auto t : cavity_) isInCavity(t) = 0;
    return false;
  }
  if (rim_.size() != cavity_.size() + 2) noteCorners();
  fill(point, room);
  hideCorners();
  return true;
}

/// Finds the cavity, the triangles that conflict with point i, and its rim. False where it reaches a triangle
/// of another region.
bool Insertion::findCavity(std::int32_t i, std::int32_t first) {
  cavity_.clear();
  rim_.clear();
  const auto take = [&](std::int32_t t) {
    isInCavity(t) = 1;
    cavity_.push_back(t);
  };
  if (!mayChange(first)) return false;
  take(first);
  // The cavity grows on the way. NOLINTNEXTLINE(modernize-loop-convert)
  for (std::size_t c = 0; c < cavity_.size(); ++c) {
    const auto here = triangle(cavity_[c]);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto other = here.neighbor[k];
      if (!mayChange(other)) return false;
      if (isInCavity(other) != 0) continue;
      if (conflicts(other, i)) {
        take(other);
      } else {
        rim_.push_back({here.corner[next(k)], here.corner[next(next(k))], other});
      }
    }
  }
  return true;
}

/// Lists the corners of the cavity; each that becomes hidden makes two triangles fewer.
void Insertion::noteCorners() {
  for (const auto t : cavity_) {
    for (const auto corner : triangle(t).corner) corners_.push_back(corner);
  }
}

/// Hides those of the listed corners that have no incident triangle any more.
void Insertion::hideCorners() {
  for (const auto corner : corners_) {
    auto& at_corner = incident(corner);
    if (at_corner == none) continue;
    const auto& left = triangle(at_corner).corner;
    if (std::find(left.begin(), left.end(), corner) != left.end()) continue;
    at_corner = none;
    hidden.push_back(corner);
  }
  corners_.clear();
}

/// Makes a triangle of p and each edge of the cavity's rim. Every corner of a removed triangle begins an edge
/// of the rim, or is hidden.
void Insertion::fill(std::int32_t p, std::int32_t room) {
  const auto newTriangle = [&] {
    mesh_.region[static_cast<std::size_t>(room)] = region_;
    return room++;
  };
  for (std::size_t r = 0; r < rim_.size(); ++r) {
    const auto [from, to, outer] = rim_[r];
    const auto t = r < cavity_.size() ? cavity_[r] : newTriangle();
    isInCavity(t) = 0;
    triangle(t) = {{p, from, to}, {outer, ghost, ghost}};
    auto& back = triangle(outer);
    for (std::size_t k = 0; k < 3; ++k) {
      if (back.corner[next(k)] == to && back.corner[next(next(k))] == from) back.neighbor[k] = t;
    }
    incident(from) = t;
    rim_[r].outer = t;
  }
  for (const auto& edge : rim_) {
    // The triangle after this one around p begins where this one ends.
    const auto after = incident(edge.to);
    triangle(edge.outer).neighbor[1] = after;
    triangle(after).neighbor[2] = edge.outer;
  }
  last_ = rim_[0].outer;
  incident(p) = last_;
  for (auto c = rim_.size(); c < cavity_.size(); ++c) leaveEmpty(cavity_[c]);
}

}  // namespace vorpipe::core
