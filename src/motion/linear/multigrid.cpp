#include "motion/linear/multigrid.h"

#include <algorithm>
#include <array>

#include "base/block_sums.h"

namespace vorpipe::moving {
namespace {

/// Row i of the matrix times x, computed from differences, so that constants cancel exactly.
float imageAt(const Level& level, const std::vector<float>& x, std::size_t i) {
  float sum = level.extra[i] * x[i];
  for (auto k = level.offsets[i]; k < level.offsets[i + 1]; ++k) {
    sum += level.coupling[k] * (x[i] - x[level.columns[k]]);
  }
  return sum;
}

template <class Body>
void byBlock(const Level& level, int threads, const Body& body) {
  parallelFor(level.rows(), sweep_block, threadsForSteps(level.rows(), threads), body);
}

/// Makes a Gauss-Seidel sweep from x = 0, by block.
void sweepForward(Level& level, int threads) {
  byBlock(level, threads, [&](std::size_t begin, std::size_t end) {
    const auto* columns = level.columns.data();
    const auto* coupling = level.coupling.data();
    auto* x = level.x.data();
    for (auto i = begin; i < end; ++i) {
      float sum = level.right[i];
      for (auto k = level.before[i]; k < level.behind[i]; ++k) sum += coupling[k] * x[columns[k]];
      x[i] = sum * level.inverse[i];
    }
  });
}

/// Sets the right side of the next level: the residual of that sweep, summed by aggregate.
void passOn(Level& level, int threads, Level& coarse) {
  // After that sweep a row's residual is from couplings to rows behind it and in other blocks. Aggregates
  // belong to one block, so that no two threads add to the same one.
  std::fill(coarse.right.begin(), coarse.right.end(), 0.f);
  byBlock(level, threads, [&](std::size_t begin, std::size_t end) {
    const auto* columns = level.columns.data();
    const auto* coupling = level.coupling.data();
    const auto* x = level.x.data();
    for (auto i = begin; i < end; ++i) {
      if (level.aggregate[i] == no_aggregate) continue;
      float sum = 0;
      for (auto k = level.offsets[i]; k < level.before[i]; ++k) sum += coupling[k] * x[columns[k]];
      for (auto k = level.behind[i]; k < level.offsets[i + 1]; ++k) sum += coupling[k] * x[columns[k]];
      coarse.right[level.aggregate[i]] += sum;
    }
  });
}

/// Adds to x the correction from the next level.
void takeBack(const Level& coarse, int threads, Level& level) {
  forAll(level.rows(), threads, [&](std::size_t i) {
    if (level.aggregate[i] != no_aggregate) level.x[i] += coarse.x[level.aggregate[i]];
  });
}

/// Makes a sweep in the other direction. Changes the right side.
void sweepBackward(Level& level, int threads) {
  const auto* columns = level.columns.data();
  const auto* coupling = level.coupling.data();
  auto* x = level.x.data();
  forAll(level.border.size(), threads, [&](std::size_t k) {
    const auto i = level.border[k];
    float sum = 0;
    for (auto l = level.offsets[i]; l < level.before[i]; ++l) sum += coupling[l] * x[columns[l]];
    level.right[i] += sum;
  });
  byBlock(level, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = end; i-- > begin;) {
      float sum = level.right[i];
      for (auto k = level.before[i]; k < level.offsets[i + 1]; ++k) sum += coupling[k] * x[columns[k]];
      x[i] = sum * level.inverse[i];
    }
  });
}

/// Solves on a level by two steps of conjugate gradients preconditioned by cycles, or by one if it reduces
/// the residual enough (Notay and Vassilevski 2008, "Recursive Krylov-based multigrid cycles"). Unsmoothed
/// aggregates make corrections too small; optimal multiples of the cycles' results compensate for that.
/// `cycle` approximately solves for level.right, stores the result in level.x, and may change the right side.
template <class Cycle>
void runTwoSteps(Level& level, int threads, const Cycle& cycle) {
  const std::size_t rows = level.rows();
  auto &x = level.x, &first = level.first, &image = level.image, &rest = level.rest;
  const auto take_first = [&](double step) {
    forAll(rows, threads, [&](std::size_t i) { x[i] = static_cast<float>(step * first[i]); });
  };
  rest = level.right;
  cycle();
  first = x;
  image.resize(rows);
  // Sums of products are in double, although the factors are not.
  using Sums = std::array<double, 3>;
  const auto [own, due, before] = sumsByBlocks<3>(rows, threads, [&](std::size_t begin, std::size_t end) {
    Sums sums{};
    for (auto i = begin; i < end; ++i) {
      image[i] = imageAt(level, first, i);
      const double own_x = first[i], right = rest[i];
      sums[0] += own_x * image[i];
      sums[1] += own_x * right;
      sums[2] += right * right;
    }
    return sums;
  });
  if (!(own > 0)) return;
  const double step = due / own;
  const auto [after] = sumsByBlocks<1>(rows, threads, [&](std::size_t begin, std::size_t end) {
    std::array<double, 1> sums{};
    for (auto i = begin; i < end; ++i) {
      rest[i] = static_cast<float>(rest[i] - step * image[i]);
      sums[0] += double{rest[i]} * rest[i];
    }
    return sums;
  });
  constexpr double enough = 0.25;
  if (after < enough * enough * before) return take_first(step);
  level.right = rest;
  cycle();
  const auto [own2, mixed, due2] = sumsByBlocks<3>(rows, threads, [&](std::size_t begin, std::size_t end) {
    Sums sums{};
    for (auto i = begin; i < end; ++i) {
      const double own_x = x[i];
      sums[0] += own_x * imageAt(level, x, i);
      sums[1] += own_x * image[i];
      sums[2] += own_x * rest[i];
    }
    return sums;
  });
  // The part of the second that is conjugate to the first.
  const double curvature = own2 - mixed * mixed / own;
  if (!(curvature > 0)) return take_first(step);
  const double step2 = due2 / curvature, step1 = step - mixed * step2 / own;
  forAll(rows, threads, [&](std::size_t i) { x[i] = static_cast<float>(step1 * first[i] + step2 * x[i]); });
}

}  // namespace

void Multigrid::build(const Laplacian& matrix, int threads) {
  // Measured with cells of random sites: greater strengths make smaller aggregates, whose longer cycles cost
  // more than the saved steps. Couplings of coarse levels are more even, so fewer of them are strong.
  constexpr float strength_of_finest = 0.15f, strength_of_next = 0.5f;
  constexpr std::size_t few_rows = 1000;
  threads_ = threads;
  count_ = 1;
  if (levels_.empty()) levels_.resize(1);
  takeMatrix(matrix, threads, levels_.front());
  float strength = strength_of_finest;
  while (levels_[count_ - 1].rows() > few_rows) {
    if (levels_.size() == count_) levels_.emplace_back();
    if (!makeCoarse(levels_[count_ - 1], strength, threads, levels_[count_])) break;
    ++count_;
    strength *= strength_of_next;
  }
  for (auto& level : levels_) {
    level.right.resize(level.rows());
    level.x.resize(level.rows());
  }
  factorCoarsest();
}

void Multigrid::factorCoarsest() {
  const auto& level = levels_[count_ - 1];
  Laplacian matrix;
  matrix.offsets.assign(level.offsets.begin(), level.offsets.end());
  matrix.columns = level.columns;
  matrix.coupling.assign(level.coupling.begin(), level.coupling.end());
  matrix.extra.assign(level.extra.begin(), level.extra.end());
  singular_ = {matrix, threads_};
  coarsest_.factor(matrix, singular_);
}

void Multigrid::solveCoarsest() {
  auto& level = levels_[count_ - 1];
  // Means are removed before and after, which keeps the operation symmetric.
  coarsest_right_.assign(level.right.begin(), level.right.end());
  singular_.removeMeans(coarsest_right_, threads_);
  coarsest_.solve(coarsest_right_, coarsest_x_);
  singular_.removeMeans(coarsest_x_, threads_);
  for (std::size_t i = 0; i < level.rows(); ++i) level.x[i] = static_cast<float>(coarsest_x_[i]);
}

void Multigrid::cycle(std::size_t number) {
  if (number + 1 == count_) return solveCoarsest();
  auto& level = levels_[number];
  auto& coarse = levels_[number + 1];
  sweepForward(level, threads_);
  passOn(level, threads_, coarse);
  if (number + 2 == count_) {
    solveCoarsest();
  } else {
    runTwoSteps(coarse, threads_, [&] { cycle(number + 1); });
  }
  takeBack(coarse, threads_, level);
  sweepBackward(level, threads_);
}

const std::vector<float>& Multigrid::solve() {
  cycle(0);
  return levels_.front().x;
}

}  // namespace vorpipe::moving
