#include "sites/grid.h"

#include <cmath>

namespace vorpipe::core {
namespace {

/// Keeps bin numbers within the integers of every device.
constexpr double most_grid_bins = 1 << 28;
/// Keeps what a device computes from the size far from underflow.
constexpr double least_size = 0x1p-100;

}  // namespace

/// The size s solves (width / s + 1) (height / s + 1) = bins, so that the grid has no more than that
/// many, however flat it is.
Grid layGrid(const Box& box, std::size_t count) {
  const double bins = std::clamp(static_cast<double>(count) / sites_per_bin, 1.0, most_grid_bins);
  const double width = box.xmax - box.xmin;
  const double height = box.ymax - box.ymin;
  Grid grid{box.xmin, box.ymin, std::max({width, height, least_size}), 1, 1, {}};
  if (bins > 2) {
    const double more = bins - 1;
    const double sum = width + height;
    const double size = (sum + std::sqrt(sum * sum + 4 * more * width * height)) / (2 * more);
    grid.size = std::max(size, least_size);
  }
  grid.columns = static_cast<std::uint32_t>(width / grid.size) + 1;
  grid.rows = static_cast<std::uint32_t>(height / grid.size) + 1;
  return grid;
}

std::uint64_t sitesIn(const Grid& grid, const BinBlock& block) {
  std::uint64_t count = 0;
  for (auto row = block.south; row <= block.north; ++row) {
    const auto* first = grid.offsets.data() + std::size_t{row} * grid.columns;
    count += first[block.east + 1] - first[block.west];
  }
  return count;
}

}  // namespace vorpipe::core
