/// Bowyer 1981, Watson 1981, by weight Edelsbrunner and Shah 1996, inserting in rounds of growing size
/// (Amenta, Choi, Rote 2003).
#include "core/delaunay.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/predicates.h"

namespace vorpipe {
namespace {

std::size_t next(std::size_t k) { return k == 2 ? 0 : k + 1; }

/// A number's bits, well mixed (splitmix64).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

/// The round from the end in which a point is inserted: 0 with probability 1/2, 1 with 1/4, and so on.
std::size_t roundOf(std::size_t point) { return static_cast<std::size_t>(std::countr_zero(mixed(point))); }

/// Rounds keep cavities small whatever the points; inside a round they keep their order, so that walks are
/// short.
std::vector<std::int32_t> insertionOrder(std::size_t count) {
  std::array<std::size_t, 66> end{};
  for (std::size_t i = 0; i < count; ++i) ++end[roundOf(i)];
  for (auto r = end.size() - 1; r > 0; --r) end[r - 1] += end[r];
  std::vector<std::int32_t> order(count);
  for (auto i = count; i-- > 0;) order[--end[roundOf(i)]] = static_cast<std::int32_t>(i);
  return order;
}

class Triangulation {
 public:
  Triangulation(const std::vector<Point>& points, const std::vector<double>& weights)
      : points_(points), weights_(weights), spoke_(points.size() + 1, none) {}

  Mesh build() {
    auto order = insertionOrder(points_.size());
    if (!begin(order)) return {};
    for (std::size_t k = 3; k < order.size(); ++k) insert(order[k]);
    return finish();
  }

 private:
  [[nodiscard]] Point at(std::int32_t i) const { return points_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] WeightedPoint weighted(std::int32_t i) const {
    return {at(i), weights_[static_cast<std::size_t>(i)]};
  }
  MeshTriangle& triangle(std::int32_t t) { return triangles_[static_cast<std::size_t>(t)]; }

  /// Makes the first triangle, of the first two points and the next that is not on their line.
  bool begin(std::vector<std::int32_t>& order) {
    if (order.size() < 3) return false;
    const auto third = std::find_if(order.begin() + 2, order.end(), [&](auto i) {
      return orientation(at(order[0]), at(order[1]), at(i)) != 0;
    });
    if (third == order.end()) return false;
    std::rotate(order.begin() + 2, third, third + 1);
    auto a = order[0], b = order[1];
    const auto c = order[2];
    if (orientation(at(a), at(b), at(c)) < 0) std::swap(a, b);
    triangles_ = {{{a, b, c}, {2, 3, 1}},
                  {{b, a, beyond}, {3, 2, 0}},
                  {{c, b, beyond}, {1, 3, 0}},
                  {{a, c, beyond}, {2, 1, 0}}};
    marked_.assign(4, 0);
    for (const auto corner : {a, b, c}) spoke(corner) = 0;
    return true;
  }

  /// Whether point i is inside a triangle's circle. That of an edge of the hull and the point at infinity is
  /// the half-plane outside, and the edge itself, as far as it does not hide the point by weight.
  ///
  /// By weight, ties are broken as if each square of a distance counted for (1 - e) of itself: what changes
  /// by that is the plain test with its sign turned. So a point whose cell has no area is hidden, and not a
  /// corner of triangles or not as the order of insertion has it.
  bool conflicts(std::int32_t t, std::int32_t i) {
    const auto& corner = triangle(t).corner;
    for (std::size_t k = 0; k < 3; ++k) {
      if (corner[k] != beyond) continue;
      const auto a = corner[next(k)], b = corner[next(next(k))];
      const int side = orientation(at(a), at(b), at(i));
      return side > 0 || (side == 0 && conflictsOnLine(a, b, i));
    }
    const auto inPlain = [&] { return inCircle(at(corner[0]), at(corner[1]), at(corner[2]), at(i)); };
    if (weights_.empty()) return inPlain() > 0;
    const int inside = inCircle(weighted(corner[0]), weighted(corner[1]), weighted(corner[2]), weighted(i));
    return inside != 0 ? inside > 0 : inPlain() < 0;
  }

  /// For point i on the line through a and b.
  bool conflictsOnLine(std::int32_t a, std::int32_t b, std::int32_t i) {
    const bool between = isBetween(at(a), at(b), at(i));
    if (weights_.empty()) return between;
    const int inside = inInterval(weighted(a), weighted(b), weighted(i));
    return inside != 0 ? inside > 0 : !between;
  }

  /// For p on the line through a and b.
  static bool isBetween(Point a, Point b, Point p) {
    return a.x != b.x ? (a.x < p.x) == (p.x < b.x) : (a.y < p.y) == (p.y < b.y);
  }

  /// A triangle at the point that was inserted and is next to i in the order of points, or near it there.
  std::int32_t nearby(std::int32_t i) {
    constexpr std::int32_t most_looked_at = 64;
    const auto first = std::max(0, i - most_looked_at);
    while (--i >= first) {
      if (spoke(i) != none) return spoke(i);
    }
    return last_;
  }

  /// Walks to a triangle that point i is in, or outside of the hull, conflicts with.
  std::int32_t locate(std::int32_t i, std::int32_t t) {
    const Point p = at(i);
    for (;;) {
      const auto& here = triangle(t);
      const auto outside = std::find(here.corner.begin(), here.corner.end(), beyond);
      if (outside != here.corner.end()) {
        if (conflicts(t, i)) return t;
        t = here.across[static_cast<std::size_t>(outside - here.corner.begin())];
        if (containsOrLeave(t, p)) return t;
        continue;
      }
      if (containsOrLeave(t, p)) return t;
    }
  }

  /// Whether p is in triangle t; else t becomes the one across an edge that has p on its other side.
  bool containsOrLeave(std::int32_t& t, Point p) {
    const auto& here = triangle(t);
    for (std::size_t k = 0; k < 3; ++k) {
      if (orientation(at(here.corner[next(k)]), at(here.corner[next(next(k))]), p) < 0) {
        t = here.across[k];
        return false;
      }
    }
    return true;
  }

  void insert(std::int32_t i) {
    const auto first = locate(i, nearby(i));
    if (!weights_.empty() && !conflicts(first, i)) {
      hidden_.push_back(i);
      return;
    }
    cavity_.assign(1, first);
    mark(first);
    rim_.clear();
    for (std::size_t c = 0; c < cavity_.size(); ++c) {
      const auto here = triangle(cavity_[c]);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto other = here.across[k];
        if (isMarked(other)) continue;
        if (conflicts(other, i)) {
          mark(other);
          cavity_.push_back(other);
        } else {
          rim_.push_back({here.corner[next(k)], here.corner[next(next(k))], other});
        }
      }
    }
    if (rim_.size() != cavity_.size() + 2) noteCorners();
    fill(i);
    hideCorners();
  }

  /// Each corner that is hidden leaves two triangles fewer.
  void noteCorners() {
    for (const auto t : cavity_) {
      for (const auto corner : triangle(t).corner) corners_.push_back(corner);
    }
  }

  /// Hides those of the noted corners that no triangle is at any more.
  void hideCorners() {
    for (const auto corner : corners_) {
      auto& at_corner = spoke(corner);
      if (at_corner == none) continue;
      const auto& left = triangle(at_corner).corner;
      if (std::find(left.begin(), left.end(), corner) != left.end()) continue;
      at_corner = none;
      hidden_.push_back(corner);
    }
    corners_.clear();
  }

  std::int32_t newTriangle() {
    if (!free_.empty()) {
      const auto t = free_.back();
      free_.pop_back();
      return t;
    }
    triangles_.emplace_back();
    marked_.push_back(0);
    return static_cast<std::int32_t>(triangles_.size()) - 1;
  }

  /// Makes a triangle of p and each edge of the cavity's rim.
  void fill(std::int32_t p) {
    for (std::size_t r = 0; r < rim_.size(); ++r) {
      const auto [from, to, outer] = rim_[r];
      const auto t = r < cavity_.size() ? cavity_[r] : newTriangle();
      marked_[static_cast<std::size_t>(t)] = 0;
      triangle(t) = {{p, from, to}, {outer, beyond, beyond}};
      auto& back = triangle(outer);
      for (std::size_t k = 0; k < 3; ++k) {
        if (back.corner[next(k)] == to && back.corner[next(next(k))] == from) back.across[k] = t;
      }
      spoke(from) = t;
      rim_[r].outer = t;
    }
    for (const auto& edge : rim_) {
      // The triangle after this one around p begins where this one ends.
      const auto after = spoke(edge.to);
      triangle(edge.outer).across[1] = after;
      triangle(after).across[2] = edge.outer;
    }
    last_ = rim_[0].outer;
    spoke(p) = last_;
    for (auto c = rim_.size(); c < cavity_.size(); ++c) {
      triangle(cavity_[c]).corner = {beyond, beyond, beyond};
      free_.push_back(cavity_[c]);
    }
  }

  std::int32_t& spoke(std::int32_t corner) { return spoke_[static_cast<std::size_t>(corner + 1)]; }
  void mark(std::int32_t t) { marked_[static_cast<std::size_t>(t)] = 1; }
  [[nodiscard]] bool isMarked(std::int32_t t) const { return marked_[static_cast<std::size_t>(t)] != 0; }

  /// Hidden points lie in triangles of others.
  void placeHidden() {
    for (const auto i : hidden_) spoke(i) = locate(i, nearby(i));
  }

  /// Closes the gaps between the triangles.
  void closeGaps() {
    std::sort(free_.begin(), free_.end());
    const auto moved = [&](std::int32_t t) {
      return t - static_cast<std::int32_t>(std::lower_bound(free_.begin(), free_.end(), t) - free_.begin());
    };
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(triangles_.size()); ++t) {
      auto here = triangle(t);
      for (auto& across : here.across) across = moved(across);
      triangle(moved(t)) = here;
    }
    triangles_.resize(triangles_.size() - free_.size());
    for (auto& t : spoke_) t = moved(t);
  }

  Mesh finish() {
    placeHidden();
    if (!free_.empty()) closeGaps();
    // Every corner of a triangle that went begins a rim edge of those that replaced it.
    spoke_.erase(spoke_.begin());
    return {std::move(triangles_), std::move(spoke_)};
  }

  static constexpr std::int32_t none = -1;

  struct RimEdge {
    std::int32_t from, to, outer;  ///< and the triangle behind it; in the end, the one before it
  };
  const std::vector<Point>& points_;
  const std::vector<double>& weights_;
  std::vector<MeshTriangle> triangles_;
  std::vector<std::uint8_t> marked_;
  std::vector<std::int32_t> cavity_;
  std::vector<RimEdge> rim_;
  std::vector<std::int32_t> free_;     ///< triangles that are none any more
  std::vector<std::int32_t> corners_;  ///< of the cavity, if some go with it
  std::vector<std::int32_t> hidden_;
  std::vector<std::int32_t> spoke_;  ///< by corner: a triangle there; the new one whose rim edge begins there
  std::int32_t last_ = 0;
};

}  // namespace

Mesh delaunay(std::vector<Point> points, std::vector<double> weights) {
  double largest = 0;
  for (const auto& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  // The decisions multiply four coordinates.
  constexpr double most = 0x1p240;
  if (largest > most) {
    for (auto& p : points) p = {std::ldexp(p.x, -64), std::ldexp(p.y, -64)};
    for (auto& weight : weights) weight = std::ldexp(weight, -128);
  }
  return Triangulation(points, weights).build();
}

}  // namespace vorpipe
