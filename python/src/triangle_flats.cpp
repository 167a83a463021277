#include <algorithm>
#include <cstddef>

#include "triangle_signs.h"
#include "triangles.h"

namespace vorpipe::python {

std::vector<std::uint8_t> flatOnHull(std::span<const Point> points, std::span<const Triangle> triangles,
                                     std::span<const Adjacent> adjacent) {
  std::vector<std::uint8_t> are_flat(triangles.size());
  std::vector<bool> are_on_hull(points.size());
  std::vector<std::size_t> next;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (adjacent[t][k] >= 0) continue;
      are_on_hull[triangles[t][(k + 1) % 3]] = are_on_hull[triangles[t][(k + 2) % 3]] = true;
      next.push_back(t);
    }
  }
  while (!next.empty()) {
    const std::size_t t = next.back();
    next.pop_back();
    const Triangle& corners = triangles[t];
    const auto inner =
        std::ranges::find_if(corners, [&](std::uint32_t point) { return !are_on_hull[point]; });
    // Without a corner inside, the others would lose what holds them together.
    if (are_flat[t] || inner == corners.end()) continue;
    if (!areOnLine(points[corners[0]], points[corners[1]], points[corners[2]])) continue;
    are_flat[t] = true;
    are_on_hull[*inner] = true;
    for (const std::int32_t other : adjacent[t]) {
      if (other >= 0) next.push_back(static_cast<std::size_t>(other));
    }
  }
  return are_flat;
}

}  // namespace vorpipe::python
