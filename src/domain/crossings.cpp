#include "domain/clip_cell.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/double_double.h"

namespace vorpipe::core {
namespace {

/// Twice the area of the triangle a, b, c.
DoubleDouble twiceArea(Point a, Point b, Point c) {
  return DoubleDouble::sum(b.x, -a.x) * DoubleDouble::sum(c.y, -a.y) -
         DoubleDouble::sum(b.y, -a.y) * DoubleDouble::sum(c.x, -a.x);
}

/// The intersection of two segments, bitwise the same for either direction of each. It lies in both segments'
/// boxes, so on an axis-parallel segment it is exact.
Point meeting(Point a, Point b, Point p, Point q) {
  if (isLess(b, a)) std::swap(a, b);
  if (isLess(q, p)) std::swap(p, q);
  const DoubleDouble at_a = twiceArea(p, q, a), at_b = twiceArea(p, q, b);
  const DoubleDouble along = at_a / (at_a - at_b);
  const auto between = [&](double from, double to) {
    return (DoubleDouble(from) + along * DoubleDouble::sum(to, -from)).high;
  };
  const Box ab = boxAround(a, b), pq = boxAround(p, q);
  return {std::clamp(between(a.x, b.x), std::max(ab.xmin, pq.xmin), std::min(ab.xmax, pq.xmax)),
          std::clamp(between(a.y, b.y), std::max(ab.ymin, pq.ymin), std::min(ab.ymax, pq.ymax))};
}

}  // namespace

void Crossings::cross(std::uint32_t edge) {
  const Point p = rings_.points[edge], q = rings_.endOf(edge);
  const Box box = boxAround(p, q);
  for (std::size_t k = 0; k < polygon_.size(); ++k) {
    const Point a = polygon_.from(k), b = polygon_.to(k);
    if (a == b || areApart(box, boxAround(a, b))) continue;
    const int side = sideOf(a, b, q);
    if (sideOf(a, b, p) == side || sideOfEdge(p, q, a) == sideOfEdge(p, q, b)) continue;
    const Point at = meeting(a, b, p, q);
    crossings_.push_back({edge, k, at, side > 0});
  }
}

/// The winding number of the polygon around p, counter-clockwise.
int Crossings::turnsAround(Point p) const {
  if (p.x < box_.xmin || p.x > box_.xmax || p.y < box_.ymin || p.y > box_.ymax) return 0;
  int turns = 0;
  for (std::size_t k = 0; k < polygon_.size(); ++k) {
    const Point a = polygon_.from(k), b = polygon_.to(k);
    const bool up = b.y > p.y;
    if ((a.y > p.y) != up && (sideOf(a, b, p) > 0) == up) turns += up ? 1 : -1;
  }
  return turns;
}

/// Sorts crossings along a segment so that they alternately enter and leave, even if rounding has merged
/// several of them.
bool Crossings::inTurns(std::vector<std::size_t>& crossings, bool enters_first, Point from, Point to) {
  std::ranges::stable_sort(crossings, {},
                           [&](std::size_t c) { return placeAlong(from, to, crossings_[c].at); });
  turn_ = crossings;
  const auto second = std::stable_partition(
      turn_.begin(), turn_.end(), [&](std::size_t c) { return crossings_[c].enters == enters_first; });
  const auto firsts = static_cast<std::size_t>(second - turn_.begin()), others = turn_.size() - firsts;
  if (firsts != others && firsts != others + 1) return false;
  for (std::size_t k = 0; k < crossings.size(); ++k) crossings[k] = turn_[k / 2 + (k % 2) * firsts];
  return true;
}

/// Follows one edge through its crossings. `inside` is whether its start lies inside the polygon; on return,
/// whether its end does.
bool Crossings::traceEdge(std::size_t first, std::size_t last, bool& inside) {
  if (first == last) return true;
  const auto edge = crossings_[first].edge;
  around_.clear();
  for (std::size_t c = first; c < last; ++c) around_.push_back(c);
  if (!inTurns(around_, !inside, rings_.points[edge], rings_.endOf(edge))) return false;
  for (const std::size_t c : around_) {
    inside = crossings_[c].enters;
    if (inside) {
      open_ = {c, no_crossing, {}};
      continue;
    }
    open_.leaves = c;
    arcs_.push_back(std::move(open_));
  }
  return true;
}

/// Traces one ring; `edges` are its edges in near_.
bool Crossings::traceRing(std::span<const std::uint32_t> edges) {
  const auto ring = rings_.ring[edges[0]];
  const bool whole = edges.size() == rings_.offsets[ring + std::size_t{1}] - rings_.offsets[ring];
  // If not all of the ring is near, start after a part that is not.
  std::size_t start = 0;
  while (!whole && rings_.next(edges[start > 0 ? start - 1 : edges.size() - 1]) == edges[start]) ++start;
  const std::size_t first_arc = arcs_.size(), first_crossing = crossings_.size();
  bool inside = isInside(rings_.points[edges[start]]);
  const bool began_inside = inside;
  open_ = {no_crossing, no_crossing, {}};
  std::uint32_t expected = edges[start];
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto edge = edges[(start + k) % edges.size()];
    if (edge != expected) {
      if (inside) return false;
      inside = isInside(rings_.points[edge]);
      if (inside) return false;
    }
    const std::size_t before = crossings_.size();
    cross(edge);
    if (!traceEdge(before, crossings_.size(), inside)) return false;
    expected = rings_.next(edge);
    if (inside) open_.points.push_back(rings_.points[expected]);
  }
  if (inside != began_inside || (inside && !whole)) return false;
  if (!inside) return true;
  if (crossings_.size() == first_crossing) {
    whole_.push_back(ring);
    return true;
  }
  // The first arc began before the first edge: in the arc that is still open.
  RingPart& head = arcs_[first_arc];
  head.enters = open_.enters;
  head.points.insert(head.points.begin(), open_.points.begin(), open_.points.end());
  return head.enters != no_crossing;
}

void Crossings::take(const Polygon& polygon, std::span<const std::uint32_t> near) {
  polygon_ = polygon;
  box_ = boxOf(polygon.vertices);
  crossings_.clear();
  arcs_.clear();
  whole_.clear();
  near_.clear();
  for (const auto e : near) {
    if (!areApart(box_, boxAround(rings_.points[e], rings_.endOf(e)))) near_.push_back(e);
  }
}

bool Crossings::find(const Polygon& polygon, std::span<const std::uint32_t> near) {
  take(polygon, near);
  for (std::size_t begin = 0, end = 0; begin < near_.size(); begin = end) {
    while (end < near_.size() && rings_.ring[near_[end]] == rings_.ring[near_[begin]]) ++end;
    if (!traceRing(std::span(near_).subspan(begin, end - begin))) return false;
  }
  return true;
}

bool Crossings::order(bool inside) {
  around_.clear();
  std::vector<std::size_t> all(crossings_.size());
  for (std::size_t c = 0; c < all.size(); ++c) all[c] = c;
  std::ranges::stable_sort(all, {}, [&](std::size_t c) { return crossings_[c].side; });
  std::vector<std::size_t> on_side;
  const bool began_inside = inside;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && crossings_[all[end]].side == crossings_[all[begin]].side) ++end;
    on_side.assign(all.begin() + static_cast<std::ptrdiff_t>(begin),
                   all.begin() + static_cast<std::ptrdiff_t>(end));
    // An entering edge has the rings' inside to its left: before it, in order around the polygon.
    const std::size_t side = crossings_[on_side.front()].side;
    if (!inTurns(on_side, inside, polygon_.from(side), polygon_.to(side))) return false;
    around_.insert(around_.end(), on_side.begin(), on_side.end());
    inside = inside != (on_side.size() % 2 == 1);
  }
  return inside == began_inside;
}

/// Adds the pieces between crossings of a segment, each as often as its count there; backward if the count is
/// negative. Entering and leaving edges alternate along the polygon, so as many edges begin at a crossing as
/// end there.
void Crossings::addPieces(std::vector<std::size_t>& crossings, Point from, Point to, int times,
                          std::size_t side, std::vector<BorderEdge>& edges) const {
  std::ranges::stable_sort(crossings, {},
                           [&](std::size_t c) { return placeAlong(from, to, crossings_[c].at); });
  Point begin = from;
  const auto add = [&](Point end) {
    const BorderEdge edge = times > 0 ? BorderEdge{begin, end, side} : BorderEdge{end, begin, side};
    if (begin != end) edges.insert(edges.end(), static_cast<std::size_t>(std::abs(times)), edge);
    begin = end;
  };
  for (const std::size_t c : crossings) {
    add(crossings_[c].at);
    times += crossings_[c].enters == (side == no_crossing) ? 1 : -1;
  }
  add(to);
}

void Crossings::border(const Polygon& polygon, std::span<const std::uint32_t> near,
                       std::span<const int> turns, std::vector<BorderEdge>& edges) {
  take(polygon, near);
  edges.clear();
  std::vector<std::vector<std::size_t>> on_side(polygon.size());
  for (const auto edge : near_) {
    const std::size_t first = crossings_.size();
    cross(edge);
    around_.clear();
    for (std::size_t c = first; c < crossings_.size(); ++c) {
      around_.push_back(c);
      on_side[crossings_[c].side].push_back(c);
    }
    const Point p = rings_.points[edge];
    addPieces(around_, p, rings_.endOf(edge), turnsAround(p), no_crossing, edges);
  }
  for (std::size_t k = 0; k < polygon.size(); ++k)
    addPieces(on_side[k], polygon.from(k), polygon.to(k), turns[k], k, edges);
}

}  // namespace vorpipe::core
