#include "sites/crowds.h"

#include <atomic>

#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t rows_at_once = 16;

/// Break-even of the walk and the triangulation, in sites in 3 x 3 bins, where 18 are normal.
constexpr std::uint64_t most_around = 32;

/// Above this part of the cells, everything is crowded.
constexpr std::size_t many_crowded = 4;

/// By bin: whether its sites are crowded. Empty if none are.
std::vector<std::uint8_t> crowdedBins(const Grid& grid, int threads) {
  std::vector<std::uint8_t> is_crowded(std::size_t{grid.columns} * grid.rows);
  std::atomic<bool> any{false};
  parallelFor(grid.rows, rows_at_once, threadsForSteps(is_crowded.size(), threads),
              [&](std::size_t begin, std::size_t end) {
                bool some = false;
                for (auto row = static_cast<std::uint32_t>(begin); row < end; ++row) {
                  const auto bin = std::size_t{row} * grid.columns;
                  for (std::uint32_t column = 0; column < grid.columns; ++column) {
                    if (grid.offsets[bin + column] == grid.offsets[bin + column + 1]) continue;
                    const BinBlock around = withMargin(grid, {column, row, column, row}, 1);
                    if (sitesIn(grid, around) <= most_around) continue;
                    is_crowded[bin + column] = 1;
                    some = true;
                  }
                }
                if (some) any = true;
              });
  return any ? is_crowded : std::vector<std::uint8_t>{};
}

}  // namespace

Crowds sortByCrowds(const Grid& grid, std::span<const std::uint32_t> which, int threads) {
  const auto is_crowded = crowdedBins(grid, threads);
  Crowds crowds;
  if (is_crowded.empty()) {
    crowds.even.assign(which.begin(), which.end());
    return crowds;
  }
  constexpr std::size_t grain = std::size_t{1} << 15;
  std::vector<Crowds> parts((which.size() + grain - 1) / grain);
  parallelFor(which.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    auto& part = parts[begin / grain];
    part.even.reserve(end - begin);
    const auto first = std::ranges::upper_bound(grid.offsets, which[begin]);
    auto bin = static_cast<std::size_t>(first - grid.offsets.begin()) - 1;
    for (auto k = begin; k < end; ++k) {
      while (grid.offsets[bin + 1] <= which[k]) ++bin;
      (is_crowded[bin] != 0 ? part.crowded : part.even).push_back(which[k]);
    }
  });
  crowds.even.reserve(which.size());
  for (const auto& part : parts) {
    crowds.even.insert(crowds.even.end(), part.even.begin(), part.even.end());
    crowds.crowded.insert(crowds.crowded.end(), part.crowded.begin(), part.crowded.end());
  }
  if (many_crowded * crowds.crowded.size() > which.size()) {
    crowds.crowded.assign(which.begin(), which.end());
    crowds.even.clear();
  }
  return crowds;
}

}  // namespace vorpipe::core
