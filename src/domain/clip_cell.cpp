#include "domain/clip_cell.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

#include "geometry/polygon_measures.h"

namespace vorpipe::core {
namespace {

/// A ring of a clipped cell under construction.
struct Ring {
  std::vector<Point> points;
  std::vector<std::int64_t> neighbors;

  void add(Point p, std::int64_t neighbor) {
    points.push_back(p);
    neighbors.push_back(neighbor);
  }
};

struct Extent {
  double area = 0, perimeter = 0;
  double across = 0;  ///< change of the area if every coordinate changes by this part of itself
};

Extent extentOf(std::span<const Point> ring) {
  Extent extent;
  const Point origin = ring.front();
  Point a = ring.back(), largest{0, 0}, way{0, 0};
  for (const Point b : ring) {
    extent.area += ((a.x - origin.x) * (b.y - origin.y) - (a.y - origin.y) * (b.x - origin.x)) / 2;
    extent.perimeter += std::hypot(b.x - a.x, b.y - a.y);
    largest = {std::max(largest.x, std::abs(b.x)), std::max(largest.y, std::abs(b.y))};
    way = {way.x + std::abs(b.x - a.x), way.y + std::abs(b.y - a.y)};
    a = b;
  }
  extent.across = largest.x * way.y + largest.y * way.x;
  return extent;
}

void dropPoints(Ring& ring) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < ring.points.size(); ++k) {
    const Point here = ring.points[k];
    if (here == nextOf(ring.points, k)) continue;
    ring.points[kept] = here;
    ring.neighbors[kept++] = ring.neighbors[k];
  }
  ring.points.resize(kept);
  ring.neighbors.resize(kept);
}

double outlineLength(const Ring& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.points.size(); ++k) {
    if (ring.neighbors[k] != wall_outline) continue;
    const Point a = ring.points[k], b = nextOf(ring.points, k);
    sum += std::hypot(b.x - a.x, b.y - a.y);
  }
  return sum;
}

/// Whether a ring is only the gap that rounding left between an edge of the outline and a coincident edge of
/// the cell. Its area is below rounding, and at least a quarter of its length belongs to the outline. In a
/// narrow cell that the outline crosses, that share is much less.
bool isSliver(const Ring& ring) {
  constexpr double rounding = 2 * std::numeric_limits<double>::epsilon(), share = 0.25;
  if (ring.points.empty()) return true;
  const double along = outlineLength(ring);
  if (along == 0) return false;
  const Extent extent = extentOf(ring.points);
  return std::abs(extent.area) <= rounding * extent.across && along >= share * extent.perimeter;
}

void append(std::span<const Point> points, std::span<const std::int64_t> neighbors, bool hole,
            ClippedCell& cell) {
  cell.hole.push_back(hole);
  cell.ring_starts.push_back(static_cast<std::uint32_t>(cell.vertices.size()));
  cell.vertices.insert(cell.vertices.end(), points.begin(), points.end());
  cell.neighbors.insert(cell.neighbors.end(), neighbors.begin(), neighbors.end());
}

/// Sort key of edges.
std::tuple<std::int64_t, double, double> placeOf(std::int64_t neighbor, Point from) {
  return {neighbor, from.x, from.y};
}

}  // namespace

struct OutlineClip::State {
  explicit State(const OutlineIndex& of) : index(of), crossings(of.rings()) {}

  [[nodiscard]] std::span<const Point> pointsOf(std::uint32_t ring) const {
    const auto& rings = index.rings();
    return std::span(rings.points)
        .subspan(rings.offsets[ring], rings.offsets[ring + std::size_t{1}] - rings.offsets[ring]);
  }

  /// Joins arcs by the polygon's sides, counter-clockwise from where one arc leaves to where the next enters.
  void join(const Polygon& polygon, std::span<const std::int64_t> neighbors) {
    const auto& around = crossings.around();
    const auto& arcs = crossings.arcs();
    place.assign(around.size(), 0);
    for (std::size_t k = 0; k < around.size(); ++k) place[around[k]] = k;
    arc_of.assign(around.size(), arcs.size());
    for (std::size_t a = 0; a < arcs.size(); ++a) arc_of[arcs[a].enters] = a;
    used.assign(arcs.size(), false);
    for (std::size_t first = 0; first < arcs.size(); ++first) {
      if (used[first]) continue;
      Ring ring;
      for (auto a = first; !used[a];) {
        used[a] = true;
        const RingPart& arc = arcs[a];
        const Crossing& leaves = crossings.all()[arc.leaves];
        ring.add(crossings.all()[arc.enters].at, wall_outline);
        for (const Point p : arc.points) ring.add(p, wall_outline);
        ring.add(leaves.at, neighbors[leaves.side]);
        const std::size_t left = place[arc.leaves], entered = (left + 1) % around.size();
        const std::size_t last = crossings.all()[around[entered]].side;
        bool there = last == leaves.side && entered > left;
        for (auto k = leaves.side; !there; there = k == last) {
          k = k + 1 < polygon.size() ? k + 1 : 0;
          ring.add(polygon.from(k), neighbors[k]);
        }
        a = arc_of[around[entered]];
      }
      dropPoints(ring);
      if (!isSliver(ring)) outer.push_back(std::move(ring));
    }
  }

  /// Which of the outer rings a hole lies in; their number if none. If the hole's own outer ring is whole,
  /// the answer is known; if it is cut, the hole may lie in any of its parts.
  [[nodiscard]] std::size_t partAround(std::uint32_t hole) const {
    const auto& whole = crossings.wholeRings();
    const auto around = index.rings().outer[hole];
    if (const auto found = std::ranges::lower_bound(whole, around);
        found != whole.end() && *found == around) {
      return part_of[static_cast<std::size_t>(found - whole.begin())];
    }
    for (std::size_t part = 0; part < parts; ++part) {
      if (parts == 1 || liesIn(outer[part].points, pointsOf(hole))) return part;
    }
    return outer.size();
  }

  /// Adds the whole rings, except holes, to the outer ones.
  void addWhole() {
    parts = outer.size();
    part_of.clear();
    for (const auto ring : crossings.wholeRings()) {
      part_of.push_back(outer.size());
      const auto points = pointsOf(ring);
      if (!index.rings().isOuter(ring)) continue;
      outer.push_back(
          {{points.begin(), points.end()}, std::vector<std::int64_t>(points.size(), wall_outline)});
    }
  }

  /// Writes the outer rings and, after each, its holes.
  void write(ClippedCell& clipped) const {
    std::vector<std::vector<std::uint32_t>> holes(outer.size());
    for (const auto ring : crossings.wholeRings()) {
      if (index.rings().isOuter(ring)) continue;
      // Holes without an outer ring lie in dropped slivers.
      if (const auto in = partAround(ring); in < outer.size()) holes[in].push_back(ring);
    }
    clipped.clear();
    std::vector<std::int64_t> along_outline;
    for (std::size_t r = 0; r < outer.size(); ++r) {
      append(outer[r].points, outer[r].neighbors, /*hole=*/false, clipped);
      for (const auto hole : holes[r]) {
        along_outline.assign(pointsOf(hole).size(), wall_outline);
        append(pointsOf(hole), along_outline, /*hole=*/true, clipped);
      }
    }
  }

  const OutlineIndex& index;
  Crossings crossings;
  std::vector<Ring> outer;  ///< first the parts of rings that are cut, then those that are whole
  std::size_t parts = 0;
  std::vector<std::size_t> part_of;        ///< index in outer of each whole ring that is not a hole
  std::vector<std::size_t> place, arc_of;  ///< by crossing: rank around the polygon; arc that enters there
  std::vector<bool> used;                  ///< by arc
};

void ClippedCell::clear() {
  vertices.clear();
  neighbors.clear();
  ring_starts.clear();
  hole.clear();
  sorted_edges.clear();
}

std::span<const Point> ClippedCell::ring(std::size_t r) const {
  const std::size_t end = r + 1 < ring_starts.size() ? ring_starts[r + 1] : vertices.size();
  return std::span(vertices).subspan(ring_starts[r], end - ring_starts[r]);
}

std::vector<Point> ClippedCell::ends() const {
  std::vector<Point> ends;
  ends.reserve(vertices.size());
  for (std::size_t r = 0; r < ring_starts.size(); ++r) {
    const auto points = ring(r);
    ends.insert(ends.end(), points.begin() + 1, points.end());
    ends.push_back(points.front());
  }
  return ends;
}

Point ClippedCell::endOf(std::uint32_t edge) const {
  const auto next_ring = std::ranges::upper_bound(ring_starts, edge);
  const std::size_t end = next_ring != ring_starts.end() ? *next_ring : vertices.size();
  return vertices[edge + std::size_t{1} < end ? edge + std::size_t{1} : *std::prev(next_ring)];
}

void ClippedCell::sortEdges() {
  sorted_edges.clear();
  for (std::uint32_t edge = 0; edge < neighbors.size(); ++edge) {
    if (neighbors[edge] >= 0) sorted_edges.push_back(edge);
  }
  std::ranges::sort(sorted_edges, {},
                    [&](std::uint32_t edge) { return placeOf(neighbors[edge], vertices[edge]); });
}

bool ClippedCell::hasEdge(std::int64_t neighbor, Point a, Point b) const {
  const auto place = [&](std::uint32_t edge) { return placeOf(neighbors[edge], vertices[edge]); };
  const auto first = std::ranges::lower_bound(sorted_edges, placeOf(neighbor, a), {}, place);
  const auto last = std::ranges::upper_bound(first, sorted_edges.end(), placeOf(neighbor, a), {}, place);
  return std::any_of(first, last, [&](std::uint32_t edge) { return endOf(edge) == b; });
}

OutlineClip::OutlineClip(const OutlineIndex& index) : state_(std::make_unique<State>(index)) {}
OutlineClip::~OutlineClip() = default;

void OutlineClip::border(std::span<const Point> vertices, std::span<const std::uint32_t> near,
                         std::vector<BorderEdge>& edges) {
  std::vector<int> turns;
  for (const Point p : vertices) turns.push_back(state_->index.turnsAround(p));
  state_->crossings.border({vertices}, near, turns, edges);
}

std::span<const Crossing> OutlineClip::crossings() const { return state_->crossings.all(); }

OutlineClip::Outcome OutlineClip::clip(std::span<const Point> vertices,
                                       std::span<const std::int64_t> neighbors,
                                       std::span<const std::uint32_t> near, ClippedCell& clipped) {
  auto& [index, crossings, outer, parts, part_of, place, arc_of, used] = *state_;
  const Polygon polygon{vertices};
  const bool inside = index.contains(vertices[0]);
  const Outcome whole = inside ? Outcome::inside : Outcome::outside;
  if (!crossings.find(polygon, near) || !crossings.order(inside)) return Outcome::crossed;
  if (crossings.all().empty() && crossings.wholeRings().empty()) return whole;
  outer.clear();
  if (crossings.all().empty() && inside) {
    outer.push_back({{vertices.begin(), vertices.end()}, {neighbors.begin(), neighbors.end()}});
  }
  state_->join(polygon, neighbors);
  state_->addWhole();
  if (outer.empty()) return Outcome::outside;
  state_->write(clipped);
  return Outcome::cut;
}

}  // namespace vorpipe::core
