#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "triangle_signs.h"
#include "triangles.h"

namespace vorpipe::python {
namespace {

class Groups {
 public:
  explicit Groups(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0); }
  std::size_t find(std::size_t member) {
    while (parents_[member] != member) member = parents_[member] = parents_[parents_[member]];
    return member;
  }
  /// The lower one stands for both, so that the numbers of centers follow those of triangles.
  void join(std::size_t a, std::size_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parents_[high] = low;
  }

 private:
  std::vector<std::size_t> parents_;
};

struct Shape {
  long double area2, height_part;  ///< twice the area, and that by the longest side's square
};

Shape shapeOf(const Point& a, const Point& b, const Point& c) {
  const long double bx = static_cast<long double>(b.x) - a.x, by = static_cast<long double>(b.y) - a.y;
  const long double cx = static_cast<long double>(c.x) - a.x, cy = static_cast<long double>(c.y) - a.y;
  const long double area2 = bx * cy - by * cx;
  const long double longest =
      std::max({bx * bx + by * by, cx * cx + cy * cy, (cx - bx) * (cx - bx) + (cy - by) * (cy - by)});
  return {area2, longest > 0 ? area2 / longest : 0};
}

Point centerOf(const Point& a, const Point& b, const Point& c) {
  // Flatter triangles have too few digits of their area left.
  constexpr long double flattest = 1e-13L;
  const Shape shape = shapeOf(a, b, c);
  if (!(shape.height_part > flattest)) {
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  }
  const long double bx = static_cast<long double>(b.x) - a.x, by = static_cast<long double>(b.y) - a.y;
  const long double cx = static_cast<long double>(c.x) - a.x, cy = static_cast<long double>(c.y) - a.y;
  const long double bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  const long double x = (cy * bb - by * cc) / (2 * shape.area2), y = (bx * cc - cx * bb) / (2 * shape.area2);
  return {static_cast<double>(a.x + x), static_cast<double>(a.y + y)};
}

void joinTies(std::span<const Point> points, std::span<const Triangle> triangles,
              std::span<const Adjacent> adjacent, Groups& groups) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle& triangle = triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t other = adjacent[t][k];
      if (other <= static_cast<std::int32_t>(t)) continue;
      const auto o = static_cast<std::size_t>(other);
      // The corner of the other one that this one does not have.
      const std::size_t beyond = adjacent[o][0] == static_cast<std::int32_t>(t)   ? 0
                                 : adjacent[o][1] == static_cast<std::int32_t>(t) ? 1
                                                                                  : 2;
      if (inCircle(points[triangle[0]], points[triangle[1]], points[triangle[2]],
                   points[triangles[o][beyond]]) == 0) {
        groups.join(t, o);
      }
    }
  }
}

}  // namespace

Centers centersOf(std::span<const Point> points, std::span<const Triangle> triangles,
                  std::span<const Adjacent> adjacent) {
  Groups groups(triangles.size());
  joinTies(points, triangles, adjacent, groups);
  Centers centers;
  centers.of_triangle.resize(triangles.size());
  std::vector<long double> best;  // of each center: how far from flat its triangle is
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle& corners = triangles[t];
    const long double part = shapeOf(points[corners[0]], points[corners[1]], points[corners[2]]).height_part;
    const std::size_t group = groups.find(t);
    if (group == t) {
      centers.of_triangle[t] = static_cast<std::int32_t>(best.size());
      best.push_back(part);
      centers.triangles.push_back(static_cast<std::int32_t>(t));
      continue;
    }
    const std::int32_t center = centers.of_triangle[t] = centers.of_triangle[group];
    const auto c = static_cast<std::size_t>(center);
    if (part <= best[c]) continue;
    best[c] = part;
    centers.triangles[c] = static_cast<std::int32_t>(t);
  }
  for (const std::int32_t t : centers.triangles) {
    const Triangle& corners = triangles[static_cast<std::size_t>(t)];
    centers.positions.push_back(centerOf(points[corners[0]], points[corners[1]], points[corners[2]]));
  }
  return centers;
}

}  // namespace vorpipe::python
