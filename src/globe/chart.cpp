#include "globe/chart.h"

#include "base/parallel.h"

namespace vorpipe::core {

Chart::Chart(Point center)
    : center_(directionOf(center)), right_(perpendicular(center_)), up_(cross(center_, right_)) {}

Point Chart::toPlane(const Direction& at) const {
  const double depth = dot(center_, at);
  return {dot(right_, at) / depth, dot(up_, at) / depth};
}

Direction Chart::toDirection(Point at) const { return normalized(center_ + at.x * right_ + at.y * up_); }

Sites Chart::toPlane(const SphereSites& sites, int threads) const {
  constexpr std::size_t grain = std::size_t{1} << 14;
  const auto count = sites.direction.size();
  Sites plane;
  for (auto* list : {&plane.x, &plane.y, &plane.weight}) list->resize(count);
  parallelFor(count, grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      const Direction way = sites.direction[i] - center_;
      const double excess = sites.excessOf(i), longer = 1 + excess;
      const double rise = longer * dot(way, way) / 2;
      plane.x[i] = longer * dot(right_, way);
      plane.y[i] = longer * dot(up_, way);
      // |v|^2 across the center's direction, plus 2 v along it, less 2.
      plane.weight[i] = 2 * excess * (1 + rise) - rise * rise;
    }
  });
  return plane;
}

}  // namespace vorpipe::core
