#include "motion/linear/multigrid.h"

#include "motion/linear/aggregates.h"
#include "motion/linear/coarse_level.h"
#include "motion/linear/finest_level.h"
#include "motion/linear/sweeps.h"

namespace vorpipe::moving {

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
    auto& fine = levels_[count_ - 1];
    const auto starts = findAggregates(fine, strength, threads);
    if (starts.back() > fine.rows() / 10 * 9) break;
    makeCoarse(fine, starts, threads, levels_[count_]);
    ++count_;
    strength *= strength_of_next;
  }
  steps_.resize(levels_.size());
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
  singular_ = SingularParts::of(matrix, threads_);
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
    steps_[number + 1].run(coarse, threads_, [&] { cycle(number + 1); });
  }
  takeBack(coarse, threads_, level);
  sweepBackward(level, threads_);
}

const std::vector<float>& Multigrid::solve() {
  cycle(0);
  return levels_.front().x;
}

}  // namespace vorpipe::moving
