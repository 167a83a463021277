#include "domain/clean_rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "geometry/predicates.h"

namespace vorpipe::core {
namespace {

/// Up to this many pairs of edges are compared one by one; for more, a tree of edges finds candidates.
constexpr std::size_t few_pairs = std::size_t{1} << 16;

/// Whether p, on the line of a and b, lies strictly between them.
bool isInside(Point a, Point b, Point p) { return p != a && p != b && isInBox(a, b, p); }

bool haveMoreThanEnds(Point a, Point b, Point c, Point d) {
  if (areApart(boxAround(a, b), boxAround(c, d))) return false;
  const int c_side = orientation(a, b, c), d_side = orientation(a, b, d);
  if (c_side * d_side > 0) return false;
  const int a_side = orientation(c, d, a), b_side = orientation(c, d, b);
  if (a_side * b_side > 0) return false;
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && isInside(a, b, c)) || (d_side == 0 && isInside(a, b, d)) ||
         (a_side == 0 && isInside(c, d, a)) || (b_side == 0 && isInside(c, d, b));
}

/// With fewer points than this, all pairs are compared.
constexpr std::size_t few_points = 16;
constexpr std::uint32_t unset = std::numeric_limits<std::uint32_t>::max();

using SegmentKey = std::tuple<double, double, double, double>;

SegmentKey keyOf(Point a, Point b) { return {a.x, a.y, b.x, b.y}; }

/// For a path from a to p: the clockwise angle from the direction back to a until the direction of p to b, in
/// half turns. The direction back itself comes last.
int halfTurns(Point a, Point p, Point b) {
  const int side = orientation(p, a, b);
  if (side != 0) return side < 0 ? 0 : 2;
  return alongWay(p, a, b) < 0 ? 1 : 3;
}

/// For a path from a to p: whether p to b comes before p to c, clockwise from the direction back to a.
bool comesFirst(Point a, Point p, Point b, Point c) {
  const int of_b = halfTurns(a, p, b), of_c = halfTurns(a, p, c);
  return of_b != of_c ? of_b < of_c : orientation(p, b, c) < 0;
}

/// Whether a closed walk is counter-clockwise; one to a point and back is a shell without width. Ties may
/// have turned the tip of a narrow cell around, so that it crosses itself. Then only the area decides, and no
/// corner.
bool isShell(std::span<const Point> walk) {
  if (walk.size() < 3) return true;
  const Point origin = walk.front();
  Point a = walk.back();
  double area = 0, terms = 0;
  for (const Point b : walk) {
    const double left = (a.x - origin.x) * (b.y - origin.y), right = (a.y - origin.y) * (b.x - origin.x);
    area += left - right;
    terms += std::abs(left) + std::abs(right);
    a = b;
  }
  const auto steps = static_cast<double>(walk.size() + 8);
  if (std::abs(area) > steps * std::numeric_limits<double>::epsilon() * terms) return area > 0;
  return isCounterClockwise(walk);
}

struct Loop {
  std::vector<std::uint32_t> edges;
  std::vector<Point> points;  ///< where they begin
  Box box{};
};

/// Traces the remaining edges of one cell.
class RingTracer {
 public:
  RingTracer(const Rings& outline, std::vector<Point> ends, ClippedCell& cell)
      : outline_(outline), cell_(cell), ends_(std::move(ends)) {}

  void run(std::span<const std::uint32_t> near) {
    labelOutline(near);
    dropOpposites();
    std::ranges::sort(kept_, {}, [&](std::uint32_t e) { return std::tuple(from(e).x, from(e).y, e); });
    numberPlaces();
    traceAll();
    write();
  }

 private:
  [[nodiscard]] Point from(std::uint32_t e) const { return cell_.vertices[e]; }
  [[nodiscard]] Point to(std::uint32_t e) const { return ends_[e]; }

  void labelOutline(std::span<const std::uint32_t> near) {
    std::vector<SegmentKey> sides;
    for (const auto e : near) sides.push_back(keyOf(outline_.points[e], outline_.endOf(e)));
    std::ranges::sort(sides);
    for (std::uint32_t e = 0; e < ends_.size(); ++e) {
      if (cell_.neighbors[e] < 0) continue;
      if (std::ranges::binary_search(sides, keyOf(from(e), to(e)))) cell_.neighbors[e] = wall_outline;
    }
  }

  /// Whether two edges with the same ends are a cell, or a part of one, that ties have left no width. It then
  /// lies between two different neighbors.
  [[nodiscard]] bool areApart(std::uint32_t e, std::uint32_t f) const {
    const auto a = cell_.neighbors[e], b = cell_.neighbors[f];
    return a >= 0 && b >= 0 && a != b;
  }

  /// Among edges with the same two ends, keeps the surplus of one direction over the other. Also keeps a pair
  /// of opposite edges that are apart.
  void dropOpposites() {
    std::vector<std::uint32_t> order(ends_.size());
    for (std::uint32_t e = 0; e < order.size(); ++e) order[e] = e;
    const auto forward = [&](std::uint32_t e) { return isLess(from(e), to(e)); };
    const auto key = [&](std::uint32_t e) {
      return forward(e) ? keyOf(from(e), to(e)) : keyOf(to(e), from(e));
    };
    std::ranges::sort(order, {}, [&](std::uint32_t e) { return std::tuple(key(e), forward(e), e); });
    for (auto first = order.begin(); first != order.end();) {
      const auto last = std::find_if(first, order.end(), [&](auto e) { return key(e) != key(*first); });
      const auto middle = std::find_if(first, last, forward);  // those before it run backward
      const auto backward_count = middle - first, forward_count = last - middle;
      if (backward_count == 1 && forward_count == 1 && areApart(*first, *middle))
        kept_.insert(kept_.end(), first, last);
      if (backward_count > forward_count) kept_.insert(kept_.end(), first + forward_count, middle);
      if (forward_count > backward_count) kept_.insert(kept_.end(), middle + backward_count, last);
      first = last;
    }
  }

  /// Numbers start points: edges that begin at the same place get the same number; as many end there.
  void numberPlaces() {
    place_.assign(ends_.size(), unset);
    for (std::uint32_t k = 0; k < kept_.size(); ++k) {
      if (k == 0 || from(kept_[k]) != from(kept_[k - 1])) first_of_.push_back(k);
      place_[kept_[k]] = static_cast<std::uint32_t>(first_of_.size() - 1);
    }
    first_of_.push_back(static_cast<std::uint32_t>(kept_.size()));
  }

  [[nodiscard]] std::uint32_t placeAtEnd(std::uint32_t e) const {
    const auto found = std::ranges::lower_bound(kept_, to(e), isLess, [&](auto k) { return from(k); });
    return place_[*found];
  }

  /// The edge along which the inside beside e continues: the first clockwise from e among those not yet used
  /// and `start`, where the ring began; unset if there are none.
  [[nodiscard]] std::uint32_t after(std::uint32_t e, std::uint32_t start) const {
    const auto place = placeAtEnd(e);
    std::uint32_t first = unset;
    for (auto k = first_of_[place]; k < first_of_[place + 1]; ++k) {
      const auto candidate = kept_[k];
      if (used_[candidate] && candidate != start) continue;
      if (first == unset || comesFirst(from(e), to(e), to(candidate), to(first))) first = candidate;
    }
    return first;
  }

  void traceAll() {
    used_.assign(ends_.size(), false);
    std::vector<std::uint32_t> starts = kept_;
    std::ranges::sort(starts);
    std::vector<std::uint32_t> walk;
    for (const auto start : starts) {
      if (used_[start]) continue;
      walk.clear();
      for (auto e = start; walk.empty() || e != start; e = after(e, start)) {
        used_[e] = true;
        walk.push_back(e);
      }
      split(walk);
    }
  }

  /// Splits loops off a closed walk wherever it returns to a place.
  void split(std::span<const std::uint32_t> walk) {
    at_.resize(first_of_.size(), unset);
    std::vector<std::uint32_t> open;
    for (const auto e : walk) {
      at_[place_[e]] = static_cast<std::uint32_t>(open.size());
      open.push_back(e);
      const auto back_at = at_[placeAtEnd(e)];
      if (back_at == unset) continue;
      addLoop(std::span(open).subspan(back_at));
      for (auto k = back_at; k < open.size(); ++k) at_[place_[open[k]]] = unset;
      open.resize(back_at);
    }
  }

  void addLoop(std::span<const std::uint32_t> edges) {
    Loop loop{{edges.begin(), edges.end()}, {}, {}};
    for (const auto e : edges) loop.points.push_back(from(e));
    loop.box = boxOf(loop.points);
    (isShell(loop.points) ? shells_ : holes_).push_back(std::move(loop));
  }

  /// The innermost shell that a hole lies in; the number of shells if there is none.
  [[nodiscard]] std::size_t shellAround(const Loop& hole) const {
    std::size_t found = shells_.size();
    for (std::size_t s = 0; s < shells_.size(); ++s) {
      const Box &outer = shells_[s].box, &inner = hole.box;
      if (inner.xmin < outer.xmin || inner.ymin < outer.ymin || inner.xmax > outer.xmax ||
          inner.ymax > outer.ymax || !liesIn(shells_[s].points, hole.points)) {
        continue;
      }
      if (found == shells_.size() || liesIn(shells_[found].points, shells_[s].points)) found = s;
    }
    return found;
  }

  /// Whether other cells, and not the outline, bound most of a loop: ties may have turned around a whole part
  /// narrower than they are.
  [[nodiscard]] bool isBesideCells(const Loop& loop) const {
    double cells = 0, border = 0;
    for (const auto e : loop.edges) {
      (cell_.neighbors[e] >= 0 ? cells : border) += std::hypot(to(e).x - from(e).x, to(e).y - from(e).y);
    }
    return cells > 3 * border;
  }

  void write() {
    std::vector<std::vector<std::size_t>> holes_of(shells_.size());
    std::vector<std::size_t> turned;
    for (std::size_t h = 0; h < holes_.size(); ++h) {
      // A hole in no shell is a part turned around, or a rounding gap beside an edge.
      if (const auto s = shellAround(holes_[h]); s < shells_.size()) {
        holes_of[s].push_back(h);
      } else if (isBesideCells(holes_[h])) {
        turned.push_back(h);
      }
    }
    ClippedCell clean;
    for (std::size_t s = 0; s < shells_.size(); ++s) {
      append(shells_[s], /*hole=*/false, clean);
      for (const auto h : holes_of[s]) append(holes_[h], /*hole=*/true, clean);
    }
    for (const auto h : turned) append(holes_[h], /*hole=*/false, clean);
    cell_ = std::move(clean);
  }

  void append(const Loop& loop, bool hole, ClippedCell& clean) const {
    clean.hole.push_back(hole);
    clean.ring_starts.push_back(static_cast<std::uint32_t>(clean.vertices.size()));
    clean.vertices.insert(clean.vertices.end(), loop.points.begin(), loop.points.end());
    for (const auto e : loop.edges) clean.neighbors.push_back(cell_.neighbors[e]);
  }

  const Rings& outline_;
  ClippedCell& cell_;
  std::vector<Point> ends_;              ///< of each edge of the cell
  std::vector<std::uint32_t> kept_;      ///< edges, sorted by start point
  std::vector<std::uint32_t> first_of_;  ///< index of the first edge in kept_, by place, and one more
  std::vector<std::uint32_t> place_;     ///< number of each edge's start point
  std::vector<std::uint32_t> at_;        ///< by place: which edge of the open walk begins there
  std::vector<bool> used_;
  std::vector<Loop> shells_, holes_;
};

}  // namespace

void findFaults(const ClippedCell& cell, std::span<const std::uint32_t> asked,
                std::vector<EdgePair>& faults) {
  const auto ends = cell.ends();
  const auto compare = [&](std::uint32_t e, std::uint32_t f) {
    if (haveMoreThanEnds(cell.vertices[e], ends[e], cell.vertices[f], ends[f])) faults.push_back({e, f});
  };
  const auto count = static_cast<std::uint32_t>(cell.vertices.size());
  if (asked.size() * count <= few_pairs) {
    for (const auto e : asked) {
      for (std::uint32_t f = 0; f < count; ++f) compare(e, f);
    }
    return;
  }
  Rings rings{cell.vertices, cell.ring_starts, {}, {}};
  rings.offsets.push_back(count);
  for (std::uint32_t r = 0; r < cell.ring_starts.size(); ++r) rings.ring.resize(rings.offsets[r + 1], r);
  const OutlineIndex index(rings);
  std::vector<std::uint32_t> near;
  for (const auto e : asked) {
    index.edgesIn(boxAround(cell.vertices[e], ends[e]), near);
    for (const auto f : near) compare(e, f);
  }
}

bool touchesItself(const ClippedCell& cell) {
  const auto& points = cell.vertices;
  if (points.size() <= few_points) {
    for (std::size_t k = 1; k < points.size(); ++k) {
      if (std::find(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(k), points[k]) !=
          points.begin() + static_cast<std::ptrdiff_t>(k)) {
        return true;
      }
    }
    return false;
  }
  std::vector<Point> sorted = points;
  std::ranges::sort(sorted, isLess);
  return std::ranges::adjacent_find(sorted) != sorted.end();
}

void cleanRings(const Rings& outline, std::span<const std::uint32_t> near, ClippedCell& cell) {
  cleanRings(outline, near, cell.ends(), cell);
}

void cleanRings(const Rings& outline, std::span<const std::uint32_t> near, std::vector<Point> ends,
                ClippedCell& cell) {
  RingTracer(outline, std::move(ends), cell).run(near);
}

}  // namespace vorpipe::core
