#include "sites/grid.h"

#include <fmt/core.h>

#include <cmath>

#include "base/refusal.h"
#include "sites/bin_sort.h"

namespace vorpipe::core {
namespace {

/// Keeps bin numbers within the integers of every device.
constexpr double most_grid_bins = 1 << 28;
/// Keeps what a device computes from the size far from underflow.
constexpr double least_size = 0x1p-100;

/// The area that the grid covers: the box of the sites, as far as it lies in `near`. If sites lie beyond, the
/// grid ends outside the domain, so the bins at its border may hold them: seen from inside the domain, such a
/// site is farther away than its bin.
Box gridBox(const Box& sites, const Box& near) {
  return {std::clamp(sites.xmin, near.xmin, near.xmax), std::clamp(sites.ymin, near.ymin, near.ymax),
          std::clamp(sites.xmax, near.xmin, near.xmax), std::clamp(sites.ymax, near.ymin, near.ymax)};
}

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

int scaleExponent(const Box& domain) {
  int exponent = 0;
  std::frexp(std::max(domain.xmax - domain.xmin, domain.ymax - domain.ymin), &exponent);
  return 1 - exponent;
}

Box scaledDomain(const Box& domain, int exponent) {
  const PowerOfTwo scale(exponent);
  const auto wall = [&](double at) { return usableCoordinate(scale(at)); };
  return {wall(domain.xmin), wall(domain.ymin), wall(domain.xmax), wall(domain.ymax)};
}

Result<void> checkDomain(const Box& domain) {
  const bool finite = std::isfinite(domain.xmin) && std::isfinite(domain.ymin) &&
                      std::isfinite(domain.xmax) && std::isfinite(domain.ymax) &&
                      std::isfinite(domain.xmax - domain.xmin) && std::isfinite(domain.ymax - domain.ymin);
  if (!finite || !(domain.xmin < domain.xmax) || !(domain.ymin < domain.ymax)) {
    return tl::unexpected(
        refusal(Subject::domain,
                fmt::format("the domain {},{},{},{} is not a rectangle with xmin < xmax and ymin < ymax",
                            domain.xmin, domain.ymin, domain.xmax, domain.ymax)));
  }
  return {};
}

Box surroundings(const Box& domain) {
  const double margin = std::max(domain.xmax - domain.xmin, domain.ymax - domain.ymin);
  return {domain.xmin - margin, domain.ymin - margin, domain.xmax + margin, domain.ymax + margin};
}

Grid gridOver(const Extent& extent, const Box& near) {
  return layGrid(gridBox(extent.box, near), extent.inside);
}

Error unusableSite(std::size_t i, double x, double y) {
  const bool finite = std::isfinite(x) && std::isfinite(y);
  return refusal(Subject::sites, fmt::format("site {} {}: {}, {}", i,
                                             finite ? "is too far from the domain" : "is not finite", x, y));
}

}  // namespace vorpipe::core
