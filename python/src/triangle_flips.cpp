#include <algorithm>
#include <cstddef>

#include "geometry/predicates.h"
#include "triangle_signs.h"
#include "triangles.h"

namespace vorpipe::python {
namespace {

using Index = std::int32_t;

std::size_t placeOf(const Adjacent& adjacent, std::size_t triangle) {
  const auto sought = static_cast<Index>(triangle);
  return adjacent[0] == sought ? 0 : adjacent[1] == sought ? 1 : 2;
}

/// Two triangles with a common side, and how they hang in the others; corners are numbered from that side's.
class Pair {
 public:
  Pair(std::vector<Triangle>& triangles, std::vector<Adjacent>& adjacent, std::size_t first,
       std::size_t corner)
      : triangles_(triangles),
        adjacent_(adjacent),
        first_(first),
        corner_(corner),
        second_(static_cast<std::size_t>(adjacent[first][corner])),
        beyond_(placeOf(adjacent[second_], first)) {}

  [[nodiscard]] bool isWrong(std::span<const Point> points, bool exactly) const {
    const auto [i, j, k] = triangles_[first_];
    const Point &a = points[i], &b = points[j], &c = points[k], &d = points[triangles_[second_][beyond_]];
    return (exactly ? core::inCircle(a, b, c, d) : inCircle(a, b, c, d)) > 0;
  }

  /// The other diagonal of their quadrilateral takes the place of the common side.
  void flip() {
    const Triangle one = triangles_[first_], two = triangles_[second_];
    const Adjacent of_one = adjacent_[first_], of_two = adjacent_[second_];
    const std::size_t k = corner_, m = beyond_;
    const std::uint32_t a = one[k], b = one[(k + 1) % 3], c = one[(k + 2) % 3], d = two[m];
    // Of the second one, c stands behind d, then b.
    const Index beside_ab = of_one[(k + 2) % 3], beside_ca = of_one[(k + 1) % 3];
    const Index beside_bd = of_two[(m + 1) % 3], beside_dc = of_two[(m + 2) % 3];
    triangles_[first_] = {a, b, d};
    triangles_[second_] = {a, d, c};
    adjacent_[first_] = {beside_bd, static_cast<Index>(second_), beside_ab};
    adjacent_[second_] = {beside_dc, beside_ca, static_cast<Index>(first_)};
    rename(beside_bd, second_, first_);
    rename(beside_ca, first_, second_);
  }

  [[nodiscard]] std::array<std::size_t, 2> members() const { return {first_, second_}; }

 private:
  void rename(Index triangle, std::size_t from, std::size_t to) {
    if (triangle < 0) return;
    Adjacent& adjacent = adjacent_[static_cast<std::size_t>(triangle)];
    std::ranges::replace(adjacent, static_cast<Index>(from), static_cast<Index>(to));
  }

  std::vector<Triangle>& triangles_;
  std::vector<Adjacent>& adjacent_;
  std::size_t first_, corner_, second_, beyond_;
};

}  // namespace

Mesh flipped(std::span<const Point> points, std::span<const Triangle> triangles,
             std::span<const Adjacent> adjacent, bool exactly) {
  Mesh mesh{{triangles.begin(), triangles.end()}, {adjacent.begin(), adjacent.end()}};
  std::vector<std::size_t> next(triangles.size());
  for (std::size_t t = 0; t < next.size(); ++t) next[t] = t;
  // Each flip lowers the triangles on the paraboloid above them, so that there is a last one.
  while (!next.empty()) {
    const std::size_t t = next.back();
    next.pop_back();
    for (std::size_t k = 0; k < 3; ++k) {
      if (mesh.adjacent[t][k] < 0) continue;
      Pair pair(mesh.triangles, mesh.adjacent, t, k);
      if (!pair.isWrong(points, exactly)) continue;
      pair.flip();
      for (const std::size_t member : pair.members()) next.push_back(member);
      break;
    }
  }
  return mesh;
}

}  // namespace vorpipe::python
