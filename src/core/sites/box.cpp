#include <algorithm>
#include <cmath>

#include "vorpipe.h"

namespace vorpipe {

Box boxOf(std::span<const Point> points) {
  const auto [left, right] = std::ranges::minmax(points, {}, &Point::x);
  const auto [low, high] = std::ranges::minmax(points, {}, &Point::y);
  return {left.x, low.y, right.x, high.y};
}

Box domainOf(const Sites& sites) {
  const auto [xmin, xmax] = std::ranges::minmax(sites.x);
  const auto [ymin, ymax] = std::ranges::minmax(sites.y);
  const double longer = std::max(xmax - xmin, ymax - ymin);
  double grown = longer > 0 ? 0.05 * longer : 0.5;
  // Far from the origin so little may be less than a coordinate can tell; a few thousand steps are not.
  const double largest = std::max({std::abs(xmin), std::abs(xmax), std::abs(ymin), std::abs(ymax)});
  const double step = largest - std::nextafter(largest, 0.0);
  grown = std::max(grown, 4096 * step);
  return Box{xmin - grown, ymin - grown, xmax + grown, ymax + grown};
}

}  // namespace vorpipe
