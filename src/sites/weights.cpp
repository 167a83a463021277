#include "sites/weights.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "base/double_double.h"
#include "base/parallel.h"
#include "base/refusal.h"
#include "sites/site_set.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t weight_pyramid_grain = std::size_t{1} << 14;
constexpr double no_weight = -std::numeric_limits<double>::infinity();

std::uint32_t halfOf(std::uint32_t count) { return (count + 1) / 2; }

/// One level of the pyramid.
struct Level {
  std::size_t first;  ///< of its values
  std::uint32_t columns, rows;
};

std::vector<Level> levelsOf(const Grid& grid) {
  std::vector<Level> levels{{0, grid.columns, grid.rows}};
  while (levels.back().columns > 1 || levels.back().rows > 1) {
    const auto [first, columns, rows] = levels.back();
    levels.push_back({first + std::size_t{columns} * rows, halfOf(columns), halfOf(rows)});
  }
  return levels;
}

/// The largest weight in a block of bins, by descent through the pyramid.
class BlockQuery {
 public:
  BlockQuery(const Grid& grid, const BinBlock& block) : grid_(grid), block_(block), levels_(levelsOf(grid)) {}

  [[nodiscard]] double run() const { return of(levels_.size() - 1, 0, 0); }

 private:
  [[nodiscard]] double of(std::size_t level, std::uint32_t column, std::uint32_t row) const {
    const auto& l = levels_[level];
    if (column >= l.columns || row >= l.rows) return no_weight;
    const BinBlock bins{column << level, row << level, (column << level) + (1u << level) - 1,
                        (row << level) + (1u << level) - 1};
    if (bins.west > block_.east || bins.east < block_.west || bins.south > block_.north ||
        bins.north < block_.south) {
      return no_weight;
    }
    const bool within = bins.west >= block_.west && bins.east <= block_.east && bins.south >= block_.south &&
                        bins.north <= block_.north;
    if (within || level == 0) return grid_.heaviest[l.first + std::size_t{row} * l.columns + column];
    return std::max({of(level - 1, 2 * column, 2 * row), of(level - 1, 2 * column + 1, 2 * row),
                     of(level - 1, 2 * column, 2 * row + 1), of(level - 1, 2 * column + 1, 2 * row + 1)});
  }

  const Grid& grid_;
  const BinBlock& block_;
  std::vector<Level> levels_;
};

void raise(Grid& grid, const BinBlock& block, double weight) {
  for (auto row = block.south; row <= block.north; ++row) {
    for (auto column = block.west; column <= block.east; ++column) {
      auto& bin = grid.heaviest[std::size_t{row} * grid.columns + column];
      bin = std::max(bin, weight);
    }
  }
}

constexpr std::size_t weights_grain = 1 << 16;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double heaviest_usable = 0x1p600;  ///< in squares of domains
/// Weights nearer to 0 become 0, as coordinates do: exact decisions multiply them by two coordinate
/// differences.
constexpr double least_weight = least_coordinate * least_coordinate;

bool isUsable(double weight) { return std::abs(weight) <= heaviest_usable; }

struct Range {
  double least = infinite, most = -infinite;
  bool usable = true;

  void add(const Range& other) {
    least = std::min(least, other.least);
    most = std::max(most, other.most);
    usable = usable && other.usable;
  }
};

Range rangeOf(const std::vector<double>& weights, int threads) {
  std::vector<Range> ranges((weights.size() + weights_grain - 1) / weights_grain);
  parallelFor(weights.size(), weights_grain, threads, [&](std::size_t begin, std::size_t end) {
    Range range;
    for (auto i = begin; i < end; ++i) range.add({weights[i], weights[i], isUsable(weights[i])});
    ranges[begin / weights_grain] = range;
  });
  Range all;
  for (const auto& range : ranges) all.add(range);
  return all;
}

/// The error of the first weight that is not usable; there is one.
Error unusableWeight(const Sites& sites, const std::vector<double>& scaled) {
  const auto first = std::find_if_not(scaled.begin(), scaled.end(), isUsable) - scaled.begin();
  const double weight = sites.weight[static_cast<std::size_t>(first)];
  return refusal(Subject::weights,
                 fmt::format("the weight of site {} is {}: {}", first,
                             std::isfinite(weight) ? "too large for the domain" : "not finite", weight));
}

void subtractIfExact(double least, int threads, std::vector<double>& weights) {
  std::atomic<bool> exact = true;
  parallelFor(weights.size(), weights_grain, threads, [&](std::size_t begin, std::size_t end) {
    bool all = true;
    for (auto i = begin; i < end; ++i) all = all && DoubleDouble::sum(weights[i], -least).low == 0;
    if (!all) exact = false;
  });
  if (!exact) return;
  parallelEach(weights.size(), weights_grain, threads, [&](std::size_t i) { weights[i] -= least; });
}

void dropTinyWeights(int threads, std::vector<double>& weights) {
  parallelEach(weights.size(), weights_grain, threads, [&](std::size_t i) {
    if (std::abs(weights[i]) < least_weight) weights[i] = 0;
  });
}

/// A site that is heavier by e than all others, in bins of size s, makes about e / s^2 cells around it search
/// e / s^2 bins each, (e / s^2)^2 in all. Trying it for every cell costs one step per site, n in all. The
/// break-even is e / s^2 = sqrt(n).
void findHeavy(SiteSet& set) {
  std::vector<std::uint32_t> all(set.size()), top(std::min(set.size(), most_heavy + 1));
  std::iota(all.begin(), all.end(), 0u);
  std::partial_sort_copy(all.begin(), all.end(), top.begin(), top.end(), [&](auto a, auto b) {
    return set.weight[a] != set.weight[b] ? set.weight[a] > set.weight[b] : set.id[a] < set.id[b];
  });
  const double least =
      set.weight[top.back()] + set.grid.size * set.grid.size * std::sqrt(static_cast<double>(set.size()));
  const auto end =
      std::find_if_not(top.begin(), top.end(), [&](auto site) { return set.weight[site] > least; });
  set.heavy.assign(top.begin(), end);
}

}  // namespace

void noteHeaviest(SiteSet& sites, int threads) {
  auto& grid = sites.grid;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  // All others are lighter than the heavy ones.
  const double heavy = sites.heavy.empty() ? infinite : sites.weight[sites.heavy.back()];
  const auto bins = std::size_t{grid.columns} * grid.rows;
  grid.heaviest.assign(bins, no_weight);
  parallelEach(bins, weight_pyramid_grain, threads, [&](std::size_t bin) {
    for (auto site = grid.offsets[bin]; site < grid.offsets[bin + 1]; ++site) {
      const double weight = sites.weight[site];
      if (weight < heavy) grid.heaviest[bin] = std::max(grid.heaviest[bin], weight);
    }
  });
}

void buildPyramid(Grid& grid) {
  const auto levels = levelsOf(grid);
  grid.heaviest.resize(levels.back().first + 1);
  for (std::size_t l = 1; l < levels.size(); ++l) {
    const auto& [first, columns, rows] = levels[l];
    const auto& below = levels[l - 1];
    const auto at = [&](std::uint32_t column, std::uint32_t row) {
      return column < below.columns && row < below.rows
                 ? grid.heaviest[below.first + std::size_t{row} * below.columns + column]
                 : no_weight;
    };
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t column = 0; column < columns; ++column) {
        grid.heaviest[first + std::size_t{row} * columns + column] =
            std::max({at(2 * column, 2 * row), at(2 * column + 1, 2 * row), at(2 * column, 2 * row + 1),
                      at(2 * column + 1, 2 * row + 1)});
      }
    }
  }
}

double heaviestIn(const Grid& grid, const BinBlock& block) { return BlockQuery(grid, block).run(); }

/// Where the part ends with the set's own grid, the set's border bins already account for sites beyond; where
/// the coverage of the set ends there, the part's coverage does too.
void countBeyond(const SiteSet& set, const BinBlock& of, SiteSet& part) {
  const auto& grid = set.grid;
  auto& bins = part.grid;
  const auto east = grid.columns - 1, north = grid.rows - 1;
  const auto column = [&](double x) { return binAlong(x, bins.xmin, bins.size, bins.columns); };
  const auto row = [&](double y) { return binAlong(y, bins.ymin, bins.size, bins.rows); };
  const auto& coverage = part.coverage;
  if (std::isfinite(coverage.xmin)) {
    const double weight = heaviestIn(grid, {0, 0, std::max(of.west, 1u) - 1, north});
    raise(bins, {0, 0, column(coverage.xmin), bins.rows - 1}, weight);
  }
  if (std::isfinite(coverage.xmax)) {
    const double weight = heaviestIn(grid, {std::min(of.east + 1, east), 0, east, north});
    raise(bins, {column(coverage.xmax), 0, bins.columns - 1, bins.rows - 1}, weight);
  }
  if (std::isfinite(coverage.ymin)) {
    const double weight = heaviestIn(grid, {0, 0, east, std::max(of.south, 1u) - 1});
    raise(bins, {0, 0, bins.columns - 1, row(coverage.ymin)}, weight);
  }
  if (std::isfinite(coverage.ymax)) {
    const double weight = heaviestIn(grid, {0, std::min(of.north + 1, north), east, north});
    raise(bins, {0, row(coverage.ymax), bins.columns - 1, bins.rows - 1}, weight);
  }
}

bool hasWeights(const Sites& sites) {
  const auto& weight = sites.weight;
  return std::adjacent_find(weight.begin(), weight.end(), std::not_equal_to<>()) != weight.end();
}

Result<std::vector<double>> scaledWeights(const Sites& sites, int exponent, int threads) {
  std::vector<double> weights(sites.weight.size());
  parallelEach(weights.size(), weights_grain, threads,
               [&](std::size_t i) { weights[i] = std::ldexp(sites.weight[i], 2 * exponent); });
  const auto range = rangeOf(weights, threads);
  if (!range.usable) return tl::unexpected(unusableWeight(sites, weights));
  if (!(range.least < range.most)) return std::vector<double>{};
  subtractIfExact(range.least, threads, weights);
  dropTinyWeights(threads, weights);
  return weights;
}

void giveWeights(const std::vector<double>& by_input, int threads, SiteSet& set) {
  if (by_input.empty()) return;
  set.weight.resize(set.size());
  parallelEach(set.size(), weights_grain, threads,
               [&](std::size_t i) { set.weight[i] = by_input[set.id[i]]; });
  const auto range = rangeOf(set.weight, threads);
  if (!(range.least < range.most)) {
    set.weight.clear();
    return;
  }
  findHeavy(set);
  noteHeaviest(set, threads);
  buildPyramid(set.grid);
}

}  // namespace vorpipe::core
