#include "geometry/insertion.h"

#include <algorithm>
#include <array>
#include <utility>

namespace vorpipe::core {
namespace {

constexpr auto none = GrowingMesh::none;

std::size_t next(std::size_t k) { return k == 2 ? 0 : k + 1; }
std::size_t before(std::size_t k) { return k == 0 ? 2 : k - 1; }

bool isGhost(const MeshTriangle& t) { return (t.corner[0] | t.corner[1] | t.corner[2]) < 0; }

/// The index of `number`, which is one of the three.
std::uint32_t placeOf(const std::array<std::int32_t, 3>& numbers, std::int32_t number) {
  return numbers[0] == number ? 0 : numbers[1] == number ? 1 : 2;
}

/// For p on the line through a and b.
bool isBetween(Point a, Point b, Point p) {
  return a.x != b.x ? (a.x < p.x) == (p.x < b.x) : (a.y < p.y) == (p.y < b.y);
}

}  // namespace

Insertion::Insertion(GrowingMesh& mesh, Region region, std::int32_t start)
    : mesh_(mesh),
      points_(mesh.points.data()),
      triangles_(mesh.triangles.data()),
      region_(region),
      is_weighted_(!mesh.weights.empty()),
      last_(start) {}

WeightedPoint Insertion::weightedPoint(std::int32_t i) const {
  return {at(i), mesh_.weights[static_cast<std::size_t>(i)]};
}

bool Insertion::mayChange(std::int32_t t) const {
  return region_ == everywhere || mesh_.region[static_cast<std::size_t>(t)] == region_;
}

bool Insertion::mayLookAt(std::int32_t t) const {
  return mayChange(t) || mesh_.region[static_cast<std::size_t>(t)] == of_several;
}

/// Whether point i conflicts with a triangle, i.e. lies inside its circumcircle. For a ghost triangle that
/// circle is the half-plane outside its hull edge, and the edge itself, unless weights hide i there.
template <bool weighted>
[[gnu::always_inline]] inline bool Insertion::conflictsAny(const MeshTriangle& t, std::int32_t i, Point p) {
  if (isGhost(t)) [[unlikely]] {
    return conflictsBeyondHull(t, i);
  }
  const auto& corner = t.corner;
  if constexpr (weighted) {
    return inCirclePerturbed(weightedPoint(corner[0]), weightedPoint(corner[1]), weightedPoint(corner[2]),
                             weightedPoint(i)) > 0;
  } else {
    return inCirclePerturbed(at(corner[0]), at(corner[1]), at(corner[2]), p) > 0;
  }
}

bool Insertion::conflicts(const MeshTriangle& t, std::int32_t i) {
  return is_weighted_ ? conflictsAny<true>(t, i, at(i)) : conflictsAny<false>(t, i, at(i));
}

bool Insertion::conflictsBeyondHull(const MeshTriangle& t, std::int32_t i) {
  const auto k = placeOf(t.corner, ghost);
  const auto a = t.corner[next(k)], b = t.corner[before(k)];
  const int side = orientation(at(a), at(b), at(i));
  return side > 0 || (side == 0 && conflictsOnLine(a, b, i));
}

/// For point i on the line through a and b: whether it conflicts with the ghost triangle of edge ab.
bool Insertion::conflictsOnLine(std::int32_t a, std::int32_t b, std::int32_t i) {
  const bool between = isBetween(at(a), at(b), at(i));
  if (!is_weighted_) return between;
  const int inside = inInterval(weightedPoint(a), weightedPoint(b), weightedPoint(i));
  return inside != 0 ? inside > 0 : !between;
}

/// Returns a triangle where an earlier walk to i ended, or one near an inserted point that closely precedes i
/// in the order of points; else the newest triangle. If another triangle has taken its slot since, that one
/// is near as well.
std::int32_t Insertion::nearby(std::int32_t i) {
  constexpr std::int32_t most_looked_at = 64;
  const auto first = std::max(0, i - most_looked_at);
  for (; i >= first; --i) {
    const auto k = static_cast<std::size_t>(i);
    if (region_ != everywhere && mesh_.region_of_point[k] != region_) continue;
    const auto t = mesh_.near[k];
    if (t != none && mayLookAt(t) && !GrowingMesh::isUnused(triangle(t))) return t;
  }
  return last_;
}

std::int32_t Insertion::locate(std::int32_t i) {
  const Point p = at(i);
  auto t = nearby(i), from = none;
  while (t != none && mayLookAt(t)) {
    const auto& here = triangle(t);
    const bool is_outside = isGhost(here);
    const bool is_found = is_outside && conflicts(here, i);
    const auto to = is_found     ? t
                    : is_outside ? here.neighbor[placeOf(here.corner, ghost)]
                                 : neighborTowards(p, t, from);
    from = std::exchange(t, to);
    if (from == t) break;
  }
  mesh_.near[static_cast<std::size_t>(i)] = from;
  return from == t ? t : none;
}

/// The neighbor of t across an edge that separates t from p; t if it contains p. The walk came from triangle
/// `from`, which is skipped: p is not on its side.
std::int32_t Insertion::neighborTowards(Point p, std::int32_t t, std::int32_t from) {
  const auto& here = triangle(t);
  for (std::size_t k = 0; k < 3; ++k) {
    if (here.neighbor[k] == from) continue;
    if (orientation(at(here.corner[next(k)]), at(here.corner[before(k)]), p) < 0) return here.neighbor[k];
  }
  return t;
}

bool Insertion::insert(std::int32_t point, std::int32_t room) {
  leaveEmpty(room);
  leaveEmpty(room + 1);
  const auto first = locate(point);
  if (first == none) return false;
  if (is_weighted_ && !conflicts(triangle(first), point)) {
    hidden.push_back(point);
    return true;
  }
  const bool found = is_weighted_ ? findCavity<true>(point, first) : findCavity<false>(point, first);
  if (is_weighted_) {
    for (const auto t : cavity_) isInCavity(t) = 0;
  }
  if (!found) return false;
  if (rim_.size() != cavity_.size() + 2) hideCorners();
  fill(point, room);
  return true;
}

/// Finds the cavity, the triangles that conflict with point i, and its rim, counter-clockwise. Returns false
/// if it reaches a triangle of another region.
template <bool weighted>
bool Insertion::findCavity(std::int32_t i, std::int32_t first) {
  const Point p = at(i);
  cavity_.clear();
  rim_.clear();
  steps_.clear();
  if (!mayChange(first)) return false;
  // Enters a triangle by the edge before `edge`, or begins with it.
  const auto take = [&](std::int32_t t, std::size_t edge, std::uint8_t edges) {
    if constexpr (weighted) isInCavity(t) = 1;
    cavity_.push_back(t);
    steps_.push_back({t, static_cast<std::uint8_t>(edge), edges});
  };
  take(first, 0, 3);
  while (!steps_.empty()) {
    auto& step = steps_.back();
    const auto t = step.triangle;
    const std::size_t k = step.edge;
    if (--step.left == 0) {
      steps_.pop_back();
    } else {
      step.edge = static_cast<std::uint8_t>(next(k));
    }
    const auto other = triangle(t).neighbor[k];
    if (!mayChange(other)) return false;
    if constexpr (weighted) {
      if (isInCavity(other) != 0) continue;
    }
    const auto& there = triangle(other);
    const auto back = placeOf(there.neighbor, t);
    if (conflictsAny<weighted>(there, i, p)) {
      take(other, next(back), 2);
    } else {
      const auto& corner = triangle(t).corner;
      rim_.push_back({corner[next(k)], corner[before(k)], other, back});
    }
  }
  return true;
}

/// Hides those corners of the cavity that are not on its rim.
void Insertion::hideCorners() {
  corners_.clear();
  for (const auto t : cavity_) {
    for (const auto corner : triangle(t).corner) corners_.push_back(corner);
  }
  std::sort(corners_.begin(), corners_.end());
  corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
  for (const auto& edge : rim_) {
    const auto at_rim = std::lower_bound(corners_.begin(), corners_.end(), edge.from);
    corners_.erase(at_rim);
  }
  hidden.insert(hidden.end(), corners_.begin(), corners_.end());
}

/// Makes a triangle of p and each edge of the cavity's rim.
void Insertion::fill(std::int32_t p, std::int32_t room) {
  for (auto slot = room; cavity_.size() < rim_.size(); ++slot) {
    if (region_ != everywhere) mesh_.region[static_cast<std::size_t>(slot)] = region_;
    cavity_.push_back(slot);
  }
  auto previous = cavity_[rim_.size() - 1];
  for (std::size_t r = 0; r < rim_.size(); ++r) {
    const auto& edge = rim_[r];
    const auto t = cavity_[r];
    const auto after = cavity_[r + 1 < rim_.size() ? r + 1 : 0];
    triangle(t) = {{p, edge.from, edge.to}, {edge.outer, after, previous}};
    triangle(edge.outer).neighbor[edge.back] = t;
    previous = t;
  }
  last_ = mesh_.near[static_cast<std::size_t>(p)] = previous;
  for (auto c = rim_.size(); c < cavity_.size(); ++c) leaveEmpty(cavity_[c]);
}

}  // namespace vorpipe::core
