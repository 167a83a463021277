#include "session/block_order.h"

#include <algorithm>
#include <cmath>

namespace vorpipe::core {
namespace {

/// Returns the number of blocks along one side of the grid, for a few places per block.
std::uint32_t sideFor(std::size_t places) {
  constexpr double places_per_block = 4, most = 512;
  return static_cast<std::uint32_t>(
      std::clamp(std::sqrt(static_cast<double>(places) / places_per_block), 1.0, most));
}

/// Also accepts NaN.
std::uint32_t blockAlong(double place, double low, double high, std::uint32_t side) {
  const double along = (place - low) / (high - low) * side;
  if (!(along > 0)) return 0;
  return along < side ? static_cast<std::uint32_t>(along) : side - 1;
}

}  // namespace

std::vector<std::uint32_t> orderByBlocks(std::span<const Point> places, const Box& box) {
  const std::uint32_t side = sideFor(places.size());
  std::vector<std::uint32_t> block(places.size());
  std::vector<std::uint32_t> next(std::size_t{side} * side + 1);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Point p = places[k];
    block[k] = blockAlong(p.y, box.ymin, box.ymax, side) * side + blockAlong(p.x, box.xmin, box.xmax, side);
    ++next[block[k] + std::size_t{1}];
  }
  for (std::size_t b = 1; b < next.size(); ++b) next[b] += next[b - 1];
  std::vector<std::uint32_t> order(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) order[next[block[k]]++] = static_cast<std::uint32_t>(k);
  return order;
}

}  // namespace vorpipe::core
