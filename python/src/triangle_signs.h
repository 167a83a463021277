/// Signs of determinants, as far as doubles can tell them: coordinates are known to their last place.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "vorpipe.h"

namespace vorpipe::python {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// A point as seen from another one, how far off either coordinate may be, and what both add to determinants.
struct Seen {
  double x, y, unsure_x, unsure_y;
  [[nodiscard]] double square() const { return x * x + y * y; }
  [[nodiscard]] Seen size() const { return {std::abs(x), std::abs(y), 0, 0}; }
  [[nodiscard]] Seen largest() const { return {std::abs(x) + unsure_x, std::abs(y) + unsure_y, 0, 0}; }
};

inline Seen seen(const Point& from, const Point& point) {
  return {point.x - from.x, point.y - from.y, epsilon * std::max(std::abs(point.x), std::abs(from.x)),
          epsilon * std::max(std::abs(point.y), std::abs(from.y))};
}

inline double determinant(const Seen& a, const Seen& b) { return a.x * b.y - a.y * b.x; }
inline double permanent(const Seen& a, const Seen& b) { return a.x * b.y + a.y * b.x; }

inline double determinant(const Seen& a, const Seen& b, const Seen& c) {
  return a.square() * determinant(b, c) - b.square() * determinant(a, c) + c.square() * determinant(a, b);
}
inline double permanent(const Seen& a, const Seen& b, const Seen& c) {
  return a.square() * permanent(b, c) + b.square() * permanent(a, c) + c.square() * permanent(a, b);
}

/// The sign of the determinant of these. 0 where it may be: sites of a lattice that was turned are as good as
/// on one circle, and on one line.
template <class... Points>
int signOf(const Points&... points) {
  const double size = permanent(points.size()...), largest = permanent(points.largest()...);
  const double value = determinant(points...);
  return std::abs(value) <= 8 * epsilon * size + (largest - size) ? 0 : value > 0 ? 1 : -1;
}

inline bool areOnLine(const Point& a, const Point& b, const Point& c) {
  return signOf(seen(a, b), seen(a, c)) == 0;
}

/// 1 where d lies inside the circle through a, b and c, which go counter-clockwise, 0 where it lies on it.
inline int inCircle(const Point& a, const Point& b, const Point& c, const Point& d) {
  return signOf(seen(d, a), seen(d, b), seen(d, c));
}

}  // namespace vorpipe::python
