#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "check/outline.h"
#include "check/places.h"
#include "geometry/predicates.h"

namespace vorpipe::core::checks {
namespace {

/// An edge of a ring; indices count within the cell.
struct RingEdge {
  Point a, b;
  std::size_t ring, next;  ///< its ring, and the edge after it
  std::int64_t neighbor;
  bool is_place;  ///< its ends differ by less than the tolerance
};

bool isBefore(Point p, Point q) { return std::tie(p.x, p.y) < std::tie(q.x, q.y); }

/// What two edges have in common: nothing, a point, or more than allowed, which includes the point.
struct Common {
  std::optional<Point> point;
  bool more = false;
  double length = 0;  ///< of the common part
};

Common commonOf(const RingEdge& e, const RingEdge& f) {
  const int c_side = orientation(e.a, e.b, f.a), d_side = orientation(e.a, e.b, f.b);
  if (c_side * d_side > 0) return {};
  const int a_side = orientation(f.a, f.b, e.a), b_side = orientation(f.a, f.b, e.b);
  if (a_side * b_side > 0) return {};
  if (c_side == 0 && d_side == 0) {
    const Point low = std::max(std::min(e.a, e.b, isBefore), std::min(f.a, f.b, isBefore), isBefore);
    const Point high = std::min(std::max(e.a, e.b, isBefore), std::max(f.a, f.b, isBefore), isBefore);
    if (isBefore(high, low)) return {};
    return {low, isBefore(low, high), length(high - low)};
  }
  if (c_side == 0) return {f.a, false};
  if (d_side == 0) return {f.b, false};
  if (a_side == 0) return {e.a, false};
  if (b_side == 0) return {e.b, false};
  const Point way = e.b - e.a, other = f.b - f.a;
  const double along = cross(f.a - e.a, other) / cross(way, other);
  return {Point{e.a.x + along * way.x, e.a.y + along * way.y}, true};
}

/// Where two rings touch.
struct Touch {
  std::size_t ring, other;  ///< in this order
  Point point;
};

/// The rings of a cell as polygons.
class CellShape {
 public:
  CellShape(const CheckedCells& run, const CheckedOutline& outline, std::size_t i, double reach)
      : run_(run), outline_(outline), cell_(i), slack_(run.rounding(i) + run.ties(reach)), rings_(run, i) {
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      for (std::size_t e = rings_.begin(r); e < rings_.end(r); ++e) {
        const std::size_t next = rings_.next(r, e);
        const bool is_place = counted(e) == counted(next) && run.vertex(e) != run.vertex(next);
        edges_.push_back(
            {counted(e), counted(next), r, next - run.begin(i), run.diagram.neighbors[e], is_place});
      }
    }
  }

  std::string wrong() {
    for (const RingEdge& e : edges_) {
      if (!std::isfinite(e.a.x) || !std::isfinite(e.a.y)) return "have a vertex that is no place";
    }
    if (isConvex()) return {};
    std::vector<Box> boxes;
    for (const RingEdge& e : edges_) boxes.push_back(boxAround(e.a, e.b));
    tree_.emplace(std::move(boxes));
    std::string text = wrongPair();
    if (text.empty()) text = wrongTurn();
    if (text.empty()) text = wrongPinch();
    return text.empty() ? wrongNesting() : text;
  }

 private:
  [[nodiscard]] Point counted(std::size_t e) const {
    const Point p = run_.vertex(e);
    return {countedCoordinate(p.x), countedCoordinate(p.y)};
  }
  [[nodiscard]] std::string at(Point p) const { return "at " + run_.text(p); }

  /// Whether the cell is one ring that turns left at each vertex and goes around once: up and down once.
  [[nodiscard]] bool isConvex() const {
    if (rings_.size() != 1) return false;
    std::size_t turns = 0;
    for (const RingEdge& e : edges_) {
      const RingEdge& f = edges_[e.next];
      if (orientation(e.a, e.b, f.b) <= 0) return false;
      if (isBefore(e.a, e.b) != isBefore(f.a, f.b)) ++turns;
    }
    return turns == 2;
  }

  /// Finds two edges that have more in common than allowed. Notes touches of different rings.
  std::string wrongPair() {
    std::string text;
    for (std::size_t e = 0; e < edges_.size() && text.empty(); ++e) {
      const RingEdge& edge = edges_[e];
      if (edge.is_place) continue;
      tree_->eachMeeting(boxAround(edge.a, edge.b), [&](std::size_t f) {
        if (f > e && text.empty() && !edges_[f].is_place) text = wrongCommon(e, f);
      });
    }
    return text;
  }

  /// The edge that follows e, skipping those that are places.
  [[nodiscard]] std::size_t after(std::size_t e) const {
    std::size_t next = edges_[e].next;
    while (next != e && edges_[next].is_place) next = edges_[next].next;
    return next;
  }

  std::string wrongCommon(std::size_t e, std::size_t f) {
    const RingEdge &edge = edges_[e], &other = edges_[f];
    const Common common = commonOf(edge, other);
    if (!common.point) return {};
    const Point p = *common.point;
    if (edge.ring != other.ring && !common.more) {
      touches_.push_back({edge.ring, other.ring, p});
      return {};
    }
    const bool follows = (after(e) == f && p == edge.b) || (after(f) == e && p == edge.a);
    if ((follows && !common.more) || isBlurred(edge, other, common)) return {};
    return common.more ? fmt::format("edges {} and {} cross or overlap {}", e, f, at(p))
                       : fmt::format("a ring touches itself {}", at(p));
  }

  /// Whether rounding and ties may have made two edges meet: each of the two true segments, which the
  /// neighbors determine, may pass beside the other.
  [[nodiscard]] bool isBlurred(const RingEdge& edge, const RingEdge& other, const Common& common) const {
    // Ties move bisectors but not the outline: without weights, edges along the outline are where it was
    // given. An exception is a ring that ties have left no area.
    const bool is_nothing = edge.ring == other.ring && areaOfRing(edge.ring) == 0;
    if (!run_.weighted && !is_nothing && (edge.neighbor == wall_outline || other.neighbor == wall_outline))
      return false;
    const Point p = *common.point;
    const double apart = std::min({distance(edge.a, other.a, other.b), distance(edge.b, other.a, other.b),
                                   distance(other.a, edge.a, edge.b), distance(other.b, edge.a, edge.b)});
    if (!(apart <= slack_)) return false;
    const auto isOnBisector = [&](const RingEdge& e) {
      return e.neighbor >= 0 &&
             isWhereSideIsBisector(run_, outline_, cell_, static_cast<std::size_t>(e.neighbor), p);
    };
    if (isOnBisector(edge) || isOnBisector(other)) return false;
    if (edge.ring == other.ring && isFlat(edge.ring)) return true;
    if (edge.neighbor >= 0 && other.neighbor >= 0)
      return edge.neighbor != other.neighbor || !(common.length > slack_);
    if (edge.neighbor >= 0 || other.neighbor >= 0) return true;
    bool corner = false;
    outline_.eachNear(p, 0, [&](std::uint32_t k) { corner = corner || outline_.edges()[k].a == p; });
    return !corner && !(common.length > slack_);
  }

  /// Checks the order of the rings of a part: first the outer one, which is counter-clockwise, then its
  /// holes.
  std::string wrongTurn() {
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      const bool is_hole = areaOfRing(r) < 0;
      if (is_hole && r == 0 && !isFlat(r)) return fmt::format("the first is clockwise {}", at(edges_[0].a));
      part_.push_back(is_hole && r > 0 ? part_.back() : r);
    }
    return {};
  }

  [[nodiscard]] double areaOfRing(std::size_t r) const {
    const Point origin = edges_[begin(r)].a;
    double area = 0;
    for (std::size_t e = begin(r); e < end(r); ++e)
      area += cross(edges_[e].a - origin, edges_[e].b - origin) / 2;
    return area;
  }

  /// Whether a ring is no wider than rounding and ties.
  [[nodiscard]] bool isFlat(std::size_t r) const {
    double around = 0;
    for (std::size_t e = begin(r); e < end(r); ++e) around += length(edges_[e].b - edges_[e].a);
    return std::abs(areaOfRing(r)) <= slack_ * around;
  }

  /// Checks that the rings of one part and the points in which they touch form no cycle.
  std::string wrongPinch() {
    std::erase_if(touches_, [&](const Touch& t) { return part_[t.ring] != part_[t.other]; });
    std::vector<std::tuple<std::size_t, PlaceKey, std::size_t>> ends;
    for (const Touch& t : touches_) {
      for (const std::size_t ring : {t.ring, t.other})
        ends.emplace_back(part_[ring], PlaceKey(t.point), ring);
    }
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::vector<std::size_t> above(rings_.size());
    std::iota(above.begin(), above.end(), std::size_t{0});
    const auto top = [&above](std::size_t r) {
      while (above[r] != r) r = above[r] = above[above[r]];
      return r;
    };
    for (std::size_t k = 1; k < ends.size(); ++k) {
      const auto& [part, point, end] = ends[k];
      const auto& [part_before, point_before, end_before] = ends[k - 1];
      if (part != part_before || point != point_before) continue;
      const std::size_t ring = top(end), other = top(end_before);
      if (ring == other) {
        const Point p{std::bit_cast<double>(point.x), std::bit_cast<double>(point.y)};
        return fmt::format("rings of one part touch more than once, {}", at(p));
      }
      above[ring] = other;
    }
    return {};
  }

  /// Checks that outer rings lie inside no part, and holes inside their own.
  std::string wrongNesting() {
    std::vector<std::uint8_t> around(rings_.size());
    for (std::size_t r = 0; r < rings_.size() && rings_.size() > 1; ++r) {
      const auto p = isFlat(r) ? std::nullopt : placeOn(r);
      if (!p) continue;
      const auto within = ringsAround(*p, r, around);
      std::ptrdiff_t parts = 0;
      bool own = false;
      for (const std::size_t other : within) {
        parts += part_[other] == other ? 1 : -1;
        own = own || other == part_[r];
      }
      if (part_[r] == r ? parts == 0 : own && parts == 1) continue;
      return part_[r] == r ? fmt::format("a part lies inside of another {}", at(*p))
                           : fmt::format("a hole lies outside of its part {}", at(*p));
    }
    return {};
  }

  /// A vertex of a ring that is not on another ring, nor within the tolerance of one.
  [[nodiscard]] std::optional<Point> placeOn(std::size_t r) const {
    for (std::size_t e = begin(r); e < end(r); ++e) {
      bool touched = false;
      const Point p = edges_[e].a;
      tree_->eachMeeting(grown(boxAround(p, p), slack_), [&](std::size_t f) {
        touched = touched || (edges_[f].ring != r && distance(p, edges_[f].a, edges_[f].b) <= slack_);
      });
      if (!touched) return edges_[e].a;
    }
    return {};
  }

  /// The rings other than r that go around p; `around` is all 0 before and after.
  [[nodiscard]] std::vector<std::size_t> ringsAround(Point p, std::size_t r,
                                                     std::vector<std::uint8_t>& around) const {
    std::vector<std::size_t> crossed;
    constexpr double farthest = std::numeric_limits<double>::infinity();
    tree_->eachMeeting({p.x, p.y, farthest, p.y}, [&](std::size_t f) {
      const auto& [a, b, ring, next, neighbor, is_place] = edges_[f];
      if (ring == r || (a.y > p.y) == (b.y > p.y)) return;
      if ((orientation(a, b, p) > 0) != (b.y > a.y)) return;
      around[ring] ^= 1;
      crossed.push_back(ring);
    });
    std::ranges::sort(crossed);
    crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());
    std::erase_if(crossed, [&](std::size_t ring) { return std::exchange(around[ring], 0) == 0; });
    return crossed;
  }

  [[nodiscard]] std::size_t begin(std::size_t r) const { return rings_.begin(r) - run_.begin(cell_); }
  [[nodiscard]] std::size_t end(std::size_t r) const { return rings_.end(r) - run_.begin(cell_); }

  const CheckedCells& run_;
  const CheckedOutline& outline_;
  std::size_t cell_;
  double slack_;
  CellRings rings_;
  std::vector<RingEdge> edges_;
  std::optional<BoxTree> tree_;  ///< of the edges
  std::vector<Touch> touches_;
  std::vector<std::size_t> part_;  ///< the outer ring of each ring
};

}  // namespace

std::string wrongShape(const CheckedCells& run, const CheckedOutline& outline, std::size_t i) {
  if (run.edges(i) == 0) return {};
  const std::string wrong =
      run.wrongAtAnyReach(i, [&](double reach) { return CellShape(run, outline, i, reach).wrong(); });
  return wrong.empty() ? wrong : fmt::format("of site {}: {}", i, wrong);
}

}  // namespace vorpipe::core::checks
