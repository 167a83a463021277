#include "motion/linear/sweeps.h"

#include <algorithm>

#include "base/block_sums.h"

namespace vorpipe::moving {
namespace {

template <class Body>
void byBlock(const Level& level, int threads, const Body& body) {
  parallelFor(level.rows(), sweep_block, threadsForSteps(level.rows(), threads), body);
}

}  // namespace

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

void takeBack(const Level& coarse, int threads, Level& level) {
  forAll(level.rows(), threads, [&](std::size_t i) {
    if (level.aggregate[i] != no_aggregate) level.x[i] += coarse.x[level.aggregate[i]];
  });
}

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

}  // namespace vorpipe::moving
