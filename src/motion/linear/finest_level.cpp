#include "motion/linear/finest_level.h"

#include <algorithm>
#include <limits>

#include "base/block_sums.h"

namespace vorpipe::moving {
namespace {

/// Counts the nonzero couplings of each row. Returns the greatest number of the matrix.
double countCouplings(const Laplacian& matrix, int threads, std::vector<std::uint32_t>& counts) {
  counts.assign(matrix.rows() + 1, 0);
  const auto greatest = byBlocks<double>(matrix.rows(), threads, [&](std::size_t begin, std::size_t end) {
    double most = 0;
    for (auto i = begin; i < end; ++i) {
      if (!matrix.extra.empty()) most = std::max(most, matrix.extra[i]);
      for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
        most = std::max(most, matrix.coupling[k]);
        counts[i] += matrix.coupling[k] > 0;
      }
    }
    return most;
  });
  double most = 0;
  for (const double value : greatest) most = std::max(most, value);
  return most;
}

struct Unit {
  double inverse;

  [[nodiscard]] float of(double value) const {
    if (!(value > 0)) return 0;
    return std::max(static_cast<float>(value * inverse), std::numeric_limits<float>::min());
  }
};

/// Copies row i, in three parts.
void takeRow(const Laplacian& matrix, std::size_t i, Unit unit, Level& level) {
  const auto block = blockOf(i);
  std::uint32_t before = 0, other = 0;
  for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
    if (!(matrix.coupling[k] > 0)) continue;
    if (blockOf(matrix.columns[k]) != block) {
      ++other;
    } else if (matrix.columns[k] < i) {
      ++before;
    }
  }
  auto at_other = level.offsets[i], at = at_other + other, at_behind = at + before;
  level.before[i] = at;
  level.behind[i] = at_behind;
  level.extra[i] = matrix.extra.empty() ? 0 : unit.of(matrix.extra[i]);
  double sum = level.extra[i];
  for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
    if (!(matrix.coupling[k] > 0)) continue;
    const auto column = matrix.columns[k];
    auto& place = blockOf(column) != block ? at_other : column < i ? at : at_behind;
    const float coupling = unit.of(matrix.coupling[k]);
    level.columns[place] = column;
    level.coupling[place++] = coupling;
    sum += coupling;
  }
  level.diagonal[i] = static_cast<float>(sum);
  level.inverse[i] = sum > 0 ? static_cast<float>(1 / sum) : 0;
}

}  // namespace

void takeMatrix(const Laplacian& matrix, int threads, Level& level) {
  const std::size_t rows = matrix.rows();
  const double most = countCouplings(matrix, threads, level.offsets);
  becomePlaces(level.offsets);
  for (auto part : {&level.before, &level.behind}) part->resize(rows);
  for (auto part : {&level.extra, &level.diagonal, &level.inverse}) part->resize(rows);
  level.columns.resize(level.offsets.back());
  level.coupling.resize(level.offsets.back());
  const Unit unit{most > 0 ? 1 / most : 1};
  forAll(rows, threads, [&](std::size_t i) { takeRow(matrix, i, unit, level); });
  findBorder(level);
}

}  // namespace vorpipe::moving
