#include <algorithm>

#include "vorpipe.h"

namespace vorpipe {

Box boxOf(std::span<const Point> points) {
  const auto [left, right] = std::ranges::minmax(points, {}, &Point::x);
  const auto [low, high] = std::ranges::minmax(points, {}, &Point::y);
  return {left.x, low.y, right.x, high.y};
}

}  // namespace vorpipe
