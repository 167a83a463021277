#include "motion/memory_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vorpipe::moving {
namespace {

/// Columns or rows of squares. Maps a coordinate to its square; coordinates beyond the domain map to the
/// border.
struct Squares {
  double low, per_length;
  std::uint32_t count;

  Squares(double from, double to, double size)
      : low(from),
        per_length(1 / size),
        count(static_cast<std::uint32_t>(std::clamp(std::ceil((to - from) / size), 1.0, 65536.0))) {}
  [[nodiscard]] std::uint32_t of(double coordinate) const {
    const double at = (coordinate - low) * per_length;
    return at > 0 ? static_cast<std::uint32_t>(std::min(at, count - 1.0)) : 0;
  }
};

}  // namespace

std::vector<std::uint32_t> memoryOrder(const Sites& sites, const Box& domain) {
  const double width = domain.xmax - domain.xmin, height = domain.ymax - domain.ymin;
  const double size = std::sqrt(2 * (width / static_cast<double>(sites.size())) * height);
  const Squares columns(domain.xmin, domain.xmax, size), rows(domain.ymin, domain.ymax, size);
  // Stable counting sorts: first by column, then by row.
  std::vector<std::uint32_t> order(sites.size()), sorted(sites.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto sortBy = [&](std::uint32_t count, const auto& keyOf) {
    std::vector<std::uint32_t> next(std::size_t{count} + 1);
    for (const auto i : order) ++next[keyOf(i) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (const auto i : order) sorted[next[keyOf(i)]++] = i;
    order.swap(sorted);
  };
  sortBy(columns.count, [&](std::uint32_t i) { return columns.of(sites.x[i]); });
  sortBy(rows.count, [&](std::uint32_t i) { return rows.of(sites.y[i]); });
  return order;
}

}  // namespace vorpipe::moving
