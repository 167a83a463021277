#include "core/delaunay/hilbert_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t hilbert_order_grain = 4096;

/// Every second bit of the result.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | (bits << 16)) & 0x0000FFFF0000FFFFu;
  bits = (bits | (bits << 8)) & 0x00FF00FF00FF00FFu;
  bits = (bits | (bits << 4)) & 0x0F0F0F0F0F0F0F0Fu;
  bits = (bits | (bits << 2)) & 0x3333333333333333u;
  return (bits | (bits << 1)) & 0x5555555555555555u;
}

using Indices = std::vector<std::uint32_t>;

/// Sorts the sites of one bin so that those near each other are near each other in the order.
void sortBin(const SiteSet& sites, std::span<std::uint32_t> bin) {
  constexpr std::size_t already_near = 4;
  if (bin.size() <= already_near) return;
  Box box{sites.x[bin[0]], sites.y[bin[0]], sites.x[bin[0]], sites.y[bin[0]]};
  for (const auto i : bin) {
    box = {std::min(box.xmin, sites.x[i]), std::min(box.ymin, sites.y[i]), std::max(box.xmax, sites.x[i]),
           std::max(box.ymax, sites.y[i])};
  }
  const double scale = 0x1p32 / (std::max(box.xmax - box.xmin, box.ymax - box.ymin) * (1 + 0x1p-30));
  if (!std::isfinite(scale)) return;
  const auto part = [scale](double way) { return spread(static_cast<std::uint32_t>(way * scale)); };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  for (const auto i : bin)
    keys.emplace_back(part(sites.x[i] - box.xmin) | part(sites.y[i] - box.ymin) << 1, i);
  std::sort(keys.begin(), keys.end());
  std::transform(keys.begin(), keys.end(), bin.begin(), [](const auto& key) { return key.second; });
}

/// Walks the bins of a grid along Hilbert's curve, those beyond its last row and column left out.
template <class Each>
class HilbertWalk {
 public:
  HilbertWalk(const Grid& grid, const Each& each) : grid_(grid), each_(each) {}

  void run() { walk(0, 0, std::bit_ceil(std::max(grid_.columns, grid_.rows)), 0); }

 private:
  /// How the curve runs through a square: through the quarters (column, row) in this order, each with its own
  /// orientation.
  struct Quarter {
    std::uint32_t column, row;
    std::size_t way;
  };

  void walk(std::uint32_t column, std::uint32_t row, std::uint32_t size, std::size_t way) {
    static constexpr std::array<std::array<Quarter, 4>, 4> ways{{
        {{{0, 0, 1}, {0, 1, 0}, {1, 1, 0}, {1, 0, 2}}},
        {{{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 3}}},
        {{{1, 1, 3}, {0, 1, 2}, {0, 0, 2}, {1, 0, 0}}},
        {{{1, 1, 2}, {1, 0, 3}, {0, 0, 3}, {0, 1, 1}}},
    }};
    if (column >= grid_.columns || row >= grid_.rows) return;
    if (size == 1) return each_(std::size_t{row} * grid_.columns + column);
    const auto half = size / 2;
    for (const auto& q : ways[way]) walk(column + q.column * half, row + q.row * half, half, q.way);
  }

  const Grid& grid_;
  const Each& each_;
};

}  // namespace

Indices orderAlongCurve(const SiteSet& sites, int threads) {
  Indices by_bin(sites.size());
  std::iota(by_bin.begin(), by_bin.end(), 0u);
  const auto& first = sites.grid.offsets;
  parallelFor(first.size() - 1, hilbert_order_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto bin = begin; bin < end; ++bin) {
      sortBin(sites, std::span(by_bin).subspan(first[bin], first[bin + 1] - first[bin]));
    }
  });
  Indices order;
  order.reserve(by_bin.size());
  const auto append = [&](std::size_t bin) {
    order.insert(order.end(), by_bin.begin() + first[bin], by_bin.begin() + first[bin + 1]);
  };
  HilbertWalk(sites.grid, append).run();
  return order;
}

}  // namespace vorpipe::core
