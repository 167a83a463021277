/// Bowyer 1981, Watson 1981, inserting in rounds of growing size (Amenta, Choi, Rote 2003).
#include "core/delaunay.h"

#include <algorithm>
#include <bit>
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

/// Each point is in the last round with probability 1/2, in the one before with 1/4, and so on, so that
/// cavities stay small whatever the points; inside a round they keep their order, so that walks are short.
std::vector<std::int32_t> insertionOrder(std::size_t count) {
  std::vector<std::pair<int, std::int32_t>> rounds(count);
  for (std::size_t i = 0; i < count; ++i) {
    rounds[i] = {-std::countr_zero(mixed(i)), static_cast<std::int32_t>(i)};
  }
  std::sort(rounds.begin(), rounds.end());
  std::vector<std::int32_t> order(count);
  std::transform(rounds.begin(), rounds.end(), order.begin(), [](const auto& r) { return r.second; });
  return order;
}

class Mesh {
 public:
  explicit Mesh(const std::vector<Point>& points) : points_(points), spoke_(points.size() + 1) {}

  std::vector<MeshTriangle> build() {
    auto order = insertionOrder(points_.size());
    if (!begin(order)) return {};
    for (std::size_t k = 3; k < order.size(); ++k) insert(order[k]);
    return finish();
  }

 private:
  [[nodiscard]] Point at(std::int32_t i) const { return points_[static_cast<std::size_t>(i)]; }
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
    return true;
  }

  /// Whether p is inside a triangle's circle. That of an edge of the hull and the point at infinity is the
  /// half-plane outside, and the edge itself.
  bool conflicts(std::int32_t t, Point p) {
    const auto& corner = triangle(t).corner;
    for (std::size_t k = 0; k < 3; ++k) {
      if (corner[k] != beyond) continue;
      const auto a = at(corner[next(k)]), b = at(corner[next(next(k))]);
      const int side = orientation(a, b, p);
      return side > 0 || (side == 0 && isBetween(a, b, p));
    }
    return inCircle(at(corner[0]), at(corner[1]), at(corner[2]), p) > 0;
  }

  /// For p on the line through a and b.
  static bool isBetween(Point a, Point b, Point p) {
    return a.x != b.x ? (a.x < p.x) == (p.x < b.x) : (a.y < p.y) == (p.y < b.y);
  }

  /// Walks to a triangle that p conflicts with.
  std::int32_t locate(Point p) {
    auto t = last_;
    for (;;) {
      const auto& here = triangle(t);
      const auto outside = std::find(here.corner.begin(), here.corner.end(), beyond);
      if (outside != here.corner.end()) {
        if (conflicts(t, p)) return t;
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
    const Point p = at(i);
    cavity_.assign(1, locate(p));
    mark(cavity_[0]);
    rim_.clear();
    for (std::size_t c = 0; c < cavity_.size(); ++c) {
      const auto here = triangle(cavity_[c]);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto other = here.across[k];
        if (isMarked(other)) continue;
        if (conflicts(other, p)) {
          mark(other);
          cavity_.push_back(other);
        } else {
          rim_.push_back({here.corner[next(k)], here.corner[next(next(k))], other});
        }
      }
    }
    fill(i);
  }

  /// Makes a triangle of p and each edge of the cavity's rim. There are two more than the cavity had.
  void fill(std::int32_t p) {
    for (std::size_t r = 0; r < rim_.size(); ++r) {
      const auto [from, to, outer] = rim_[r];
      std::int32_t t = 0;
      if (r < cavity_.size()) {
        t = cavity_[r];
      } else {
        t = static_cast<std::int32_t>(triangles_.size());
        triangles_.emplace_back();
        marked_.push_back(0);
      }
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
  }

  std::int32_t& spoke(std::int32_t corner) { return spoke_[static_cast<std::size_t>(corner + 1)]; }
  void mark(std::int32_t t) { marked_[static_cast<std::size_t>(t)] = 1; }
  [[nodiscard]] bool isMarked(std::int32_t t) const { return marked_[static_cast<std::size_t>(t)] != 0; }
  std::vector<MeshTriangle> finish() { return std::move(triangles_); }

  struct RimEdge {
    std::int32_t from, to, outer;  ///< and the triangle behind it; in the end, the one before it
  };
  const std::vector<Point>& points_;
  std::vector<MeshTriangle> triangles_;
  std::vector<std::uint8_t> marked_;
  std::vector<std::int32_t> cavity_;
  std::vector<RimEdge> rim_;
  std::vector<std::int32_t> spoke_;  ///< by corner: the new triangle whose rim edge begins there
  std::int32_t last_ = 0;
};

}  // namespace

std::vector<MeshTriangle> delaunay(const std::vector<Point>& points) { return Mesh(points).build(); }

}  // namespace vorpipe
